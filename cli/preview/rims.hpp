// Outlines of areas that are drawn filled.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace pulvis {

using Loop = std::vector<std::size_t>;     // nodes in order
using Face = std::vector<std::size_t>;     // nodes, all faces with the same orientation
using PlanePoint = std::array<double, 2>;  // m

// Chains of edges that belong to only one face: the outline, and the rims of holes.
std::vector<Loop> rims_of(const std::vector<Face>& faces);

// The corners of the convex hull, counter-clockwise.
std::vector<PlanePoint> convex_hull(std::vector<PlanePoint> points);

}  // namespace pulvis
