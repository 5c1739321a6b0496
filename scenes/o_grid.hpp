// Quads inside a closed outline: a core of columns x rows, inside rings that end on the outline. Without
// rings the core's rim is the outline: a plain grid.
#pragma once

#include <array>
#include <vector>

#include "components/shape.hpp"

namespace pulvis {

using Quad = std::array<Row<Node>, 4>;

// Node numbers: ring 0 is the outline, counter-clockwise from its lower left corner, ring `rings` the rim
// of the core, then the core's inside by rows.
struct OGrid {
  int columns, rows;  // of the core: edges of the horizontal and vertical sides
  int rings;

  int around() const { return 2 * (columns + rows); }
  int rim(int ring, int i) const { return ring * around() + (i + around()) % around(); }
  int core(int column, int row) const;
  int nodes() const { return (rings + 1) * around() + (columns - 1) * (rows - 1); }
};

// Quads of the outermost ring first.
std::vector<Quad> quads_of(const OGrid& grid);

// Nodes from those of the outline and of the core's rim. `shares`: how far each ring lies on the way from
// the core (0) to the outline (1), outline first. The inside of the core is interpolated between its sides,
// at the stations (in [-1, 1]) of its columns and rows.
std::vector<Point> nodes_of(const OGrid& grid, const std::vector<Point>& outline,
                            const std::vector<Point>& rim, const std::vector<double>& shares,
                            const std::vector<double>& columns, const std::vector<double>& rows);

// Stations from the lengths of the edges of a mirror-symmetric side.
std::vector<double> stations_of(const std::vector<double>& lengths);

// Shares of rings that get thinner outwards, the outermost by `refinement`.
std::vector<double> ring_shares(int rings, double refinement);

Point between(const Point& a, const Point& b, double share);

}  // namespace pulvis
