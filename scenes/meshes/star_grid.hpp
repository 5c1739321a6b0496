// The O-grid inside any closed polygon of boundary nodes that is star-shaped about an inner point.
#pragma once

#include <vector>

#include "scenes/meshes/o_grid.hpp"

namespace pulvis {

struct StarGrid {
  std::vector<Point> nodes;  // boundary nodes first, in the given order
  std::vector<Quad> quads;   // quads on the boundary first
};

// The core's corners are placed at the boundary nodes that give the best quads; of two about equally good grids,
// the one that keeps more of the outline's symmetry axes is used.
StarGrid star_grid(const std::vector<Point>& boundary, const Point& centre, int rings);

}  // namespace pulvis
