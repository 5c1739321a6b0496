// Volumes of bodies in the cells of a regular grid, exact for bodies bounded by triangles.
//
// Law      Gauss: the part of a triangle above (outward normal up: +) or below (-) a column of cells bounds the volume under
//          it. Its piece in the cell [z_k, z_k+1] adds the integral of (z - z_k) over its projection on that column, and the
//          full height times the projection to all cells below
// Clipping a triangle is cut by the grid planes normal to x, then y, then z; pieces stay convex
// Symbols  m; cells count from the low corner of the grid; triangles are counter-clockwise seen from outside
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "components/space/shape.hpp"
#include "engine/portable_math.hpp"

namespace pulvis::space::kernels {

struct GridAxis {
  double low = 0, cell = 1;
  int count = 1;

  double line(int i) const { return low + i * cell; }
  // -1 and `count` are outside.
  int cell_of(double x) const {
    return static_cast<int>(std::clamp(std::floor((x - low) / cell), -1.0, count * 1.0));
  }
};
using Grid = std::array<GridAxis, 3>;

// Convex: a triangle cut by the two planes of a slab along each of the three axes.
struct Piece {
  std::array<Point, 10> corner;
  std::size_t count = 0;

  void add(const Point& p) { corner[count++] = p; }
  std::span<const Point> corners() const { return {corner.data(), count}; }
};

struct Halves {
  Piece low, high;
};

inline Halves cut(const Piece& piece, std::size_t axis, double at) {
  Halves halves;
  for (std::size_t i = 0; i < piece.count; ++i) {
    const Point &a = piece.corner[i], &b = piece.corner[(i + 1) % piece.count];
    const double below_a = at - a[axis], below_b = at - b[axis];
    (below_a >= 0 ? halves.low : halves.high).add(a);
    if ((below_a >= 0) == (below_b >= 0)) continue;
    const double share = below_a / (below_a - below_b);
    Point on;
    for (std::size_t k = 0; k < 3; ++k) on[k] = a[k] + share * (b[k] - a[k]);
    on[axis] = at;
    halves.low.add(on);
    halves.high.add(on);
  }
  return halves;
}

// visit(i, piece in slab i); slabs -1 and `count` are unbounded.
template <class Visit>
void for_slabs(const GridAxis& lines, std::size_t axis, Piece rest, const Visit& visit) {
  if (rest.count == 0) return;
  const auto along = [axis](const Point& a, const Point& b) { return a[axis] < b[axis]; };
  const auto [least, most] = std::ranges::minmax_element(rest.corners(), along);
  const int last = lines.cell_of((*most)[axis]);
  for (int i = lines.cell_of((*least)[axis]); i < last && rest.count > 0; ++i) {
    const Halves halves = cut(rest, axis, lines.line(i + 1));
    if (halves.low.count > 2) visit(i, halves.low);
    rest = halves.high;
  }
  if (rest.count > 2) visit(last, rest);
}

struct Shadow {       // projection of a piece on a plane normal to z
  double area = 0;    // m^2, < 0 if the outward normal points down
  double moment = 0;  // m^3, integral of z over it
};

inline Shadow projection_of(const Piece& piece) {
  Shadow sum;
  const Point& a = piece.corner[0];
  for (std::size_t i = 2; i < piece.count; ++i) {
    const Point &b = piece.corner[i - 1], &c = piece.corner[i];
    const double area = 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]));
    sum.area += area;
    sum.moment += area * (a[2] + b[2] + c[2]) / 3;
  }
  return sum;
}

// The volumes of one body in the cells of a box within the grid. The body may leave the box sideways or downwards only
// where it also leaves the grid.
class CellVolumes {
 public:
  // For a body that extends from `low` to `high`.
  CellVolumes(const Grid& grid, const Point& low, const Point& high) : grid_(grid) {
    for (std::size_t k = 0; k < 3; ++k) {
      first_[k] = std::max(grid[k].cell_of(low[k]), 0);
      const int last = std::min(grid[k].cell_of(high[k]), grid[k].count - 1);
      count_[k] = std::max(0, last - first_[k] + 1);
    }
    const auto layers = static_cast<std::size_t>(count_[2]) + 1;  // the last one is above the box
    volume_.assign(columns() * layers, 0);
    above_.assign(columns() * layers, 0);
  }

  void add(const Point& a, const Point& b, const Point& c) {
    if (columns() == 0) return;
    Piece triangle;
    for (const Point& p : {a, b, c}) triangle.add(p);
    for_slabs(grid_[0], 0, triangle, [&](int i, const Piece& in_x) {
      if (!is_in(0, i)) return;
      for_slabs(grid_[1], 1, in_x, [&](int j, const Piece& in_y) {
        if (!is_in(1, j)) return;
        for_slabs(grid_[2], 2, in_y, [&](int k, const Piece& piece) { add_piece(i, j, k, piece); });
      });
    });
  }

  // visit(cell, volume) for non-empty cells, numbered x first, then y, then z.
  template <class Visit>
  void finish(const Visit& visit) const {
    const double height = grid_[2].cell, least = 1e-12 * grid_[0].cell * grid_[1].cell * height;
    for (int j = 0; j < count_[1]; ++j)
      for (int i = 0; i < count_[0]; ++i) {
        double above = 0;
        for (int k = count_[2]; k >= 0; --k) {
          const double volume = volume_[at(i, j, k)] + height * above;
          above += above_[at(i, j, k)];
          if (k == count_[2] || volume <= least) continue;
          visit(
              (static_cast<std::size_t>(first_[2] + k) * static_cast<std::size_t>(grid_[1].count) +
               static_cast<std::size_t>(first_[1] + j)) *
                      static_cast<std::size_t>(grid_[0].count) +
                  static_cast<std::size_t>(first_[0] + i),
              volume);
        }
      }
  }

 private:
  std::size_t columns() const {
    return static_cast<std::size_t>(count_[0]) * static_cast<std::size_t>(count_[1]);
  }
  bool is_in(std::size_t axis, int i) const {
    return i >= first_[axis] && i < first_[axis] + count_[axis];
  }
  std::size_t at(int i, int j, int k) const {
    return (static_cast<std::size_t>(k) * static_cast<std::size_t>(count_[1]) +
            static_cast<std::size_t>(j)) *
               static_cast<std::size_t>(count_[0]) +
           static_cast<std::size_t>(i);
  }
  void add_piece(int i, int j, int k, const Piece& piece) {
    if (k < first_[2]) return;  // below the grid
    const int layer = std::min(k - first_[2], count_[2]);
    const Shadow of = projection_of(piece);
    const std::size_t cell = at(i - first_[0], j - first_[1], layer);
    above_[cell] += of.area;
    if (layer < count_[2]) volume_[cell] += of.moment - of.area * grid_[2].line(k);
  }

  const Grid& grid_;
  std::array<int, 3> first_{}, count_{};
  std::vector<double> volume_;  // m^3, from the surface in the cell
  std::vector<double> above_;   // m^2, projected surface in it that bounds the cells below
};

// ---- the space in a round die ---------------------------------------------------------------------------
// m^2: area of a circle about the origin within [0, x] x [0, y], with the sign of x y.
inline double circle_in_quadrant(double radius, double x, double y) {
  const double sign = (x < 0 ? -1.0 : 1.0) * (y < 0 ? -1.0 : 1.0);
  const double a = std::min(std::abs(x), radius), b = std::min(std::abs(y), radius);
  const double square = radius * radius;
  if (a * a + b * b <= square) return sign * a * b;
  const auto under_arc = [&](double t) {  // integral of sqrt(radius^2 - t^2)
    const double side = std::sqrt(std::max(0.0, square - t * t));
    return 0.5 * (t * side + square * portable::atan2(t, side));
  };
  const double bend = std::sqrt(std::max(0.0, square - b * b));
  return sign * (b * bend + under_arc(a) - under_arc(bend));
}

inline double circle_in_rectangle(double radius, const std::array<double, 2>& x,
                                  const std::array<double, 2>& y) {
  return circle_in_quadrant(radius, x[1], y[1]) - circle_in_quadrant(radius, x[0], y[1]) -
         circle_in_quadrant(radius, x[1], y[0]) + circle_in_quadrant(radius, x[0], y[0]);
}

}  // namespace pulvis::space::kernels
