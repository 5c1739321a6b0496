// Polygons cut into convex pieces.
#pragma once

#include <vector>
#include "scenes/outlines/portable.hpp"

namespace pulvis {

// The pieces of a simple polygon, counter-clockwise: itself where it is convex, otherwise triangles that
// are joined as long as they stay convex (Hertel and Mehlhorn 1983).
std::vector<std::vector<portable::V2>> convex_pieces(const std::vector<portable::V2>& polygon);

}  // namespace pulvis
