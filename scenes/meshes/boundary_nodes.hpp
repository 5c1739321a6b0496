// Positions of a mesh's boundary nodes on an outline curve.
#pragma once

#include <vector>

#include "scenes/meshes/smooth_outline.hpp"
#include "scenes/outlines/outline_curve.hpp"

namespace pulvis {

struct BoundaryNodes {
  std::vector<OutlinePoint> points;
  std::vector<int> corners;  // for a sharp outline: corner indices, ascending, the first is 0
};

// `edges` must be at least `fewest_edges`. Even spacing where the curve is flat enough; an edge turns by at
// most 22.5 degrees, and edges grow from there. A sharp outline has straight sides, each divided evenly.
BoundaryNodes boundary_nodes(const OutlineCurve& curve, int edges);

int fewest_edges(const OutlineCurve& curve);                // a multiple of 4
int edges_of_size(const OutlineCurve& curve, double size);  // a multiple of 4, > 0

}  // namespace pulvis
