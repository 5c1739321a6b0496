// Voronoi cells of points in the plane.
#pragma once

#include <vector>

#include "scenes/language/vectors.hpp"

namespace pulvis {

struct VoronoiCells {
  struct Side {     // from its vertex to that of the next side
    int vertex;     // index into `vertices`
    int neighbour;  // the site on its other side
  };
  std::vector<Vec2> vertices;
  std::vector<std::vector<Side>> cells;  // [sites], counter-clockwise
};

// Every cell is closed, as if more sites stood on a circle of four times the radius of all, far enough to change
// nothing within that radius. `radius` (m): of a circle around the origin that contains all sites.
VoronoiCells voronoi_cells(const std::vector<Vec2>& sites, double radius);

}  // namespace pulvis
