// Moves the nodes inside a mesh so that its quads become square and equally large.
#pragma once

#include <vector>

#include "scenes/meshes/o_grid.hpp"

namespace pulvis {

// Least mean of (shape + size) over all corners of all quads, 2 for equal squares; the first `fixed` nodes stay
// where they are. Elements that were folded are unfolded, where that can be. Returns the mean.
//
// Source: Garanzha et al., Foldover-free maps in 50 lines of code, ACM Trans. Graph. 40 (2021) 102, with the
// corners of quads for triangles; minimised by L-BFGS (Nocedal & Wright, 7.4).
//
// `size_share` of the measure is size, the rest shape.
double smooth_mesh(std::vector<Point>& nodes, const std::vector<Quad>& quads, std::size_t fixed,
                   double size_share, int max_iterations);

}  // namespace pulvis
