#include "scenes/meshes/o_grid.hpp"

#include <cmath>
#include <numeric>

#include "engine/portable_math.hpp"

namespace pulvis {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

Quad quad(int a, int b, int c, int d) {
  return {Row<Node>(a), Row<Node>(b), Row<Node>(c), Row<Node>(d)};
}

// Transfinite interpolation between the sides of the core; u, v in [0, 1].
Point core_point(const OGrid& grid, const std::vector<Point>& nodes, int column, int row, double u,
                 double v) {
  const auto node = [&](int c, int r) { return nodes[at(grid.core(c, r))]; };
  const int right = grid.columns, top = grid.rows;
  Point p;
  for (std::size_t k = 0; k < 2; ++k)
    p[k] = (1 - v) * node(column, 0)[k] + v * node(column, top)[k] + (1 - u) * node(0, row)[k] +
           u * node(right, row)[k] -
           ((1 - u) * (1 - v) * node(0, 0)[k] + u * (1 - v) * node(right, 0)[k] +
            u * v * node(right, top)[k] + (1 - u) * v * node(0, top)[k]);
  return p;
}

}  // namespace

int OGrid::core_rim(int i) const {
  const int at = (i + core_around()) % core_around();
  return coarse_core ? (rings + 1) * around() + 2 * core_around() + at : rim(rings, at);
}

int OGrid::core(int column, int row) const {
  if (row == 0) return core_rim(column);
  if (column == columns) return core_rim(columns + row);
  if (row == rows) return core_rim(2 * columns + rows - column);
  if (column == 0) return core_rim(core_around() - row);
  return first_inside() + (row - 1) * (columns - 1) + column - 1;
}

namespace {

void add_transition(const OGrid& grid, std::vector<Quad>& quads) {
  for (int i = 0; i < grid.core_around(); ++i) {
    const auto p = [&](int k) { return grid.rim(grid.rings, 3 * i + k); };
    const int q1 = grid.waist(i, 0), q2 = grid.waist(i, 1);
    const int a = grid.core_rim(i), b = grid.core_rim(i + 1);
    quads.push_back(quad(p(0), p(1), q1, a));
    quads.push_back(quad(p(1), p(2), q2, q1));
    quads.push_back(quad(p(2), p(3), b, q2));
    quads.push_back(quad(q1, q2, b, a));
  }
}

}  // namespace

std::vector<Quad> quads_of(const OGrid& grid) {
  std::vector<Quad> quads;
  for (int r = 0; r < grid.rings; ++r)
    for (int i = 0; i < grid.around(); ++i)
      quads.push_back(
          quad(grid.rim(r, i), grid.rim(r, i + 1), grid.rim(r + 1, i + 1), grid.rim(r + 1, i)));
  if (grid.coarse_core) add_transition(grid, quads);
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column)
      quads.push_back(quad(grid.core(column, row), grid.core(column + 1, row),
                           grid.core(column + 1, row + 1), grid.core(column, row + 1)));
  return quads;
}

std::vector<Point> nodes_of(const OGrid& grid, const std::vector<Point>& outline,
                            const std::vector<Point>& rim, const std::vector<double>& shares,
                            const std::vector<double>& columns, const std::vector<double>& rows) {
  std::vector<Point> nodes(at(grid.nodes()));
  const auto on_the_way = [&](int i, double share) {
    return between(rim[at(i)], outline[at(i)], share);
  };
  for (int r = 0; r <= grid.rings; ++r)
    for (int i = 0; i < grid.around(); ++i)
      nodes[at(grid.rim(r, i))] = on_the_way(i, shares[at(r)]);
  for (int i = 0; grid.coarse_core && i < grid.core_around(); ++i) {
    nodes[at(grid.core_rim(i))] = rim[at(3 * i)];
    for (int side = 0; side < 2; ++side)
      nodes[at(grid.waist(i, side))] = on_the_way(3 * i + 1 + side, shares.back());
  }
  const int stride = grid.coarse_core ? 3 : 1;
  for (int row = 1; row < grid.rows; ++row)
    for (int column = 1; column < grid.columns; ++column)
      nodes[at(grid.core(column, row))] =
          core_point(grid, nodes, column, row, 0.5 * (columns[at(stride * column)] + 1),
                     0.5 * (rows[at(stride * row)] + 1));
  return nodes;
}

std::vector<double> stations_of(const std::vector<double>& lengths) {
  const double total = std::accumulate(lengths.begin(), lengths.end(), 0.0);
  std::vector<double> t{-1};
  for (const double length : lengths) t.push_back(t.back() + 2 * length / total);
  t.back() = 1;
  for (std::size_t i = 0; i < t.size() / 2; ++i) t[t.size() - 1 - i] = -t[i];  // exact symmetry
  if (lengths.size() % 2 == 0) t[t.size() / 2] = 0;
  return t;
}

std::vector<double> ring_shares(int rings, double refinement) {
  std::vector<double> share{1};
  double total = 0;
  std::vector<double> thickness;
  for (int r = 0; r < rings; ++r) {
    thickness.push_back(portable::pow(refinement, rings > 1 ? r / (rings - 1.0) : 0));
    total += thickness.back();
  }
  for (const double t : thickness) share.push_back(share.back() - t / total);
  if (rings > 0) share.back() = 0;
  return share;
}

Point between(const Point& a, const Point& b, double share) {
  return {a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])};
}

}  // namespace pulvis
