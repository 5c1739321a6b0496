// Quads inside a closed outline: a core of columns x rows inside rings that end on the outline. Without
// rings the core's rim is the outline: a plain grid. With a coarse core, one edge of its rim corresponds to
// three of the innermost ring, joined by four quads:
//
//   P0 --- P1 --- P2 --- P3      the innermost ring
//    \     |      |     /
//     \    Q1 --- Q2   /         the waist: two nodes for each edge of the rim
//      \  /        \  /
//       A ----------- B          rim of the core
#pragma once

#include <array>
#include <vector>

#include "components/shape.hpp"

namespace pulvis {

using Quad = std::array<Row<Node>, 4>;

// Node numbers: ring 0 is the outline, counter-clockwise from its lower left corner, and so on inwards; ring
// `rings` is the rim of an even core. With a coarse core the waist and the rim follow. The core's interior
// comes last, row by row.
struct OGrid {
  int columns, rows;  // of the core: edges of the horizontal and vertical sides
  int rings;
  bool coarse_core = false;

  int core_around() const { return 2 * (columns + rows); }
  int around() const { return (coarse_core ? 3 : 1) * core_around(); }
  int rim(int ring, int i) const { return ring * around() + (i + around()) % around(); }
  int waist(int i, int side) const { return (rings + 1) * around() + 2 * i + side; }  // side 0 or 1
  int core_rim(int i) const;
  int core(int column, int row) const;
  int nodes() const { return first_inside() + (columns - 1) * (rows - 1); }

 private:
  int first_inside() const {
    return (rings + 1) * around() + (coarse_core ? 3 * core_around() : 0);
  }
};

// The outermost ring's quads come first.
std::vector<Quad> quads_of(const OGrid& grid);

// Nodes from those of the outline and as many on the core's rim (a coarse core uses every
// third). `shares`: position of each ring between the core (0) and the outline (1), outline first; with
// a coarse core the waist's comes last. The interior of the core is interpolated between its sides, at the
// stations (in [-1, 1]) of the outline's columns and rows.
std::vector<Point> nodes_of(const OGrid& grid, const std::vector<Point>& outline,
                            const std::vector<Point>& rim, const std::vector<double>& shares,
                            const std::vector<double>& columns, const std::vector<double>& rows);

// Stations from the edge lengths of a mirror-symmetric side.
std::vector<double> stations_of(const std::vector<double>& lengths);

// Shares of rings that become thinner outwards, the outermost by `refinement`.
std::vector<double> ring_shares(int rings, double refinement);

Point between(const Point& a, const Point& b, double share);

}  // namespace pulvis
