// Convex decomposition of polygons.
#pragma once

#include <vector>
#include "scenes/outlines/portable.hpp"

namespace pulvis {

// The pieces of a simple counter-clockwise polygon: itself if it is convex, otherwise triangles that
// are merged as long as the result is convex (Hertel and Mehlhorn 1983).
std::vector<std::vector<portable::V2>> convex_pieces(const std::vector<portable::V2>& polygon);

}  // namespace pulvis
