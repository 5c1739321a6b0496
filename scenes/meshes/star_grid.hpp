// The O-grid inside any closed polygon of boundary nodes, all of which one point inside sees.
#pragma once

#include <vector>

#include "scenes/meshes/o_grid.hpp"

namespace pulvis {

struct StarGrid {
  std::vector<Point> nodes;  // those of the boundary first, as given
  std::vector<Quad> quads;   // those on the boundary first
};

// Which boundary nodes lie at the core's corners is what gives the best quads; where two such grids are about as
// good, the one that keeps more of the outline's mirror lines.
StarGrid star_grid(const std::vector<Point>& boundary, const Point& centre, int rings);

}  // namespace pulvis
