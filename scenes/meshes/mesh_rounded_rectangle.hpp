// How the boundary edges of a rounded rectangle are distributed.
#pragma once

#include <vector>

#include "scenes/spec/scene.hpp"

namespace pulvis {

// A side extends from the middle of one arc to the middle of the next.
struct RoundedSides {
  std::vector<double> columns, rows;  // m, edge lengths along the horizontal and vertical sides
  double
      growth;  // largest ratio of the lengths of two neighbours; huge when there are too few edges
};

RoundedSides share_edges(const RoundedRectangleOutline& rectangle, int boundary_edges);

// Beyond this growth the curve is inaccurate: a uniform pressure misloads a node by some 4%.
inline constexpr double max_edge_growth = 2.2;

// The smallest number of boundary edges whose growth is allowed.
int fewest_edges(const RoundedRectangleOutline& rectangle);

}  // namespace pulvis
