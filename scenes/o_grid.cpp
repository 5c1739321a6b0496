#include "scenes/o_grid.hpp"

#include <cmath>
#include <numeric>

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

int OGrid::core(int column, int row) const {
  if (row == 0) return rim(rings, column);
  if (column == columns) return rim(rings, columns + row);
  if (row == rows) return rim(rings, 2 * columns + rows - column);
  if (column == 0) return rim(rings, around() - row);
  return (rings + 1) * around() + (row - 1) * (columns - 1) + column - 1;
}

std::vector<Quad> quads_of(const OGrid& grid) {
  std::vector<Quad> quads;
  for (int r = 0; r < grid.rings; ++r)
    for (int i = 0; i < grid.around(); ++i)
      quads.push_back(
          quad(grid.rim(r, i), grid.rim(r, i + 1), grid.rim(r + 1, i + 1), grid.rim(r + 1, i)));
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
  for (int i = 0; i < grid.around(); ++i)
    for (int r = 0; r <= grid.rings; ++r)
      nodes[at(grid.rim(r, i))] = between(rim[at(i)], outline[at(i)], shares[at(r)]);
  for (int row = 1; row < grid.rows; ++row)
    for (int column = 1; column < grid.columns; ++column)
      nodes[at(grid.core(column, row))] = core_point(
          grid, nodes, column, row, 0.5 * (columns[at(column)] + 1), 0.5 * (rows[at(row)] + 1));
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
    thickness.push_back(std::pow(refinement, rings > 1 ? r / (rings - 1.0) : 0));
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
