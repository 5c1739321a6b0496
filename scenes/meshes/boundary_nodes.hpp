// Where the boundary nodes of a mesh stand on an outline's curve.
#pragma once

#include <vector>

#include "scenes/meshes/smooth_outline.hpp"
#include "scenes/outlines/outline_curve.hpp"

namespace pulvis {

struct BoundaryNodes {
  std::vector<OutlinePoint> points;
  std::vector<int> corners;  // of a sharp outline: its corners' numbers, rising, the first is 0
};

// `edges` at least `fewest_edges`. Even where the curve is flat enough; an edge turns by at most an eighth of
// half a turn and from there its neighbours grow. A sharp outline has straight sides, each divided evenly.
BoundaryNodes boundary_nodes(const OutlineCurve& curve, int edges);

int fewest_edges(const OutlineCurve& curve);                // a multiple of 4
int edges_of_size(const OutlineCurve& curve, double size);  // a multiple of 4, > 0

}  // namespace pulvis
