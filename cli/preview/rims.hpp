// Outlines of what is drawn as filled areas.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace pulvis {

using Loop = std::vector<std::size_t>;     // nodes, one after the other
using Face = std::vector<std::size_t>;     // nodes, all faces the same way round
using PlanePoint = std::array<double, 2>;  // m

// Chains of edges that one face alone has: the outline, and the rims of holes.
std::vector<Loop> rims_of(const std::vector<Face>& faces);

// The corners of the convex hull, counter-clockwise.
std::vector<PlanePoint> convex_hull(std::vector<PlanePoint> points);

}  // namespace pulvis
