// The O-grid of a rectangle with rounded corners; a disc is the limiting case.
#pragma once

#include <vector>

#include "components/shape.hpp"

namespace pulvis {

struct RoundGrid {
  Point size;                         // m, width and height
  double radius;                      // m, of the corners
  std::vector<double> columns, rows;  // stations along the horizontal and vertical sides
  int rings;                          // 0: the core's rim is the outline
  double ring_refinement = 1;         // thickness ratio of the innermost to the outermost ring
  double short_waves = 0;             // fourth difference of the contact curve
  bool coarse_core = false;           // one edge of the core for three of the outline
};

void mesh_round(const RoundGrid& round, double phase, Shape& shape);

Point turned(const Point& p, double angle);

}  // namespace pulvis
