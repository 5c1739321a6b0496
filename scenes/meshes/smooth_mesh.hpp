// Moves the interior nodes of a mesh so that its quads become square and equal in size.
#pragma once

#include <vector>

#include "scenes/meshes/o_grid.hpp"

namespace pulvis {

// Minimises the mean of (shape + size) over all corners of all quads, 2 for equal squares; the first `fixed`
// nodes do not move. Folded elements are unfolded where possible. The minimum is found to round-off, and the measure
// is without dimension: a scaled, turned or mirrored outline has the scaled, turned or mirrored mesh.
//
// Source: Garanzha et al., Foldover-free maps in 50 lines of code, ACM Trans. Graph. 40 (2021) 102, with the
// corners of quads for triangles; minimised by Newton's method (scenes/meshes/newton.hpp).
//
// `size_share` is the weight of size in the measure, the rest is shape.
void smooth_mesh(std::vector<Point>& nodes, const std::vector<Quad>& quads, std::size_t fixed,
                 double size_share);

// About the mean that this would reach, after a few iterations of L-BFGS: ranks grids at a fraction of the cost.
double rough_measure(const std::vector<Point>& nodes, const std::vector<Quad>& quads,
                     std::size_t fixed, double size_share, int iterations);

}  // namespace pulvis
