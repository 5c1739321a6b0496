// Areas of the intersections of closed outlines with each cell of a rectangular grid, exact.
//
// Law      Green: the area of an outline (material on the left) between the lines y = b and y = b + h and
//          within a strip of x is -integral of clamp(y - b, 0, h) dx over its edges in the strip. Edges are
//          straight, so that the integral is that of trapezoids. No outline is clipped or closed again: any
//          simple polygon will do, with holes (clockwise), inside, across or around the grid.
// Cost     per edge: the cells that it crosses; everything below an edge is accumulated at the end.
// Range    coordinates in units of a cell, from the lower left corner of the grid
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace pulvis::kernels {

class CellAreas {
 public:
  CellAreas(int columns, int rows)
      : columns_(columns),
        rows_(rows),
        crossed_(count(columns, rows)),
        below_(count(columns, rows + 1)) {}

  // From (x0, y0) to (x1, y1). `weight` 1, or -1 if the material is on the right.
  void add_edge(double x0, double y0, double x1, double y1, double weight = 1) {
    if (x0 == x1) return;
    if (x0 < x1)
      add_rising(x0, y0, x1, y1, -weight);
    else
      add_rising(x1, y1, x0, y0, weight);
  }

  // [rows * columns] from the bottom, in units of a cell.
  std::vector<double> areas() const {
    std::vector<double> sum = crossed_;
    for (int i = 0; i < columns_; ++i) {
      double whole = 0;
      for (int j = rows_ - 1; j >= 0; --j) {
        whole += below_[at(i, j + 1)];
        sum[at(i, j)] += whole;
      }
    }
    return sum;
  }

 private:
  static std::size_t count(int columns, int rows) {
    return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  }
  std::size_t at(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }

  void add_rising(double x0, double y0, double x1, double y1, double weight) {
    const double from = std::max(x0, 0.0), to = std::min(x1, static_cast<double>(columns_));
    if (!(from < to)) return;
    const double slope = (y1 - y0) / (x1 - x0);
    const auto height = [&](double x) { return x == x1 ? y1 : y0 + slope * (x - x0); };
    double x = from, y = height(from);
    for (int i = static_cast<int>(from); x < to; ++i) {
      const double next = std::min(to, i + 1.0), y_next = height(next);
      add_in_column(i, std::min(y, y_next), std::max(y, y_next), weight * (next - x));
      x = next;
      y = y_next;
    }
  }

  // An edge of signed width `width` from height `low` to `high`, up or down, in column i.
  void add_in_column(int i, double low, double high, double width) {
    if (!(high > 0)) return;
    const auto rows = static_cast<double>(rows_);
    const int first = static_cast<int>(std::clamp(std::floor(low), 0.0, rows));
    const int last = static_cast<int>(std::clamp(std::ceil(high), 0.0, rows));
    below_[at(i, first)] += width;  // all rows under `first`
    for (int j = first; j < last; ++j) crossed_[at(i, j)] += width * mean_height(low - j, high - j);
  }

  // Mean of clamp(y, 0, 1) for y from `low` to `high`.
  static double mean_height(double low, double high) {
    const double inside_low = std::clamp(low, 0.0, 1.0), inside_high = std::clamp(high, 0.0, 1.0);
    const double middle = 0.5 * (inside_low + inside_high);
    if (inside_low == low && inside_high == high) return middle;
    const double share = (inside_high - inside_low) / (high - low);
    const double above = std::max(0.0, high - std::max(low, 1.0)) / (high - low);
    return share * middle + above;
  }

  int columns_, rows_;
  std::vector<double> crossed_;  // [rows * columns]: from edges within the cell
  std::vector<double> below_;    // [(rows + 1) * columns]: widths of edges with so many rows below
};

}  // namespace pulvis::kernels
