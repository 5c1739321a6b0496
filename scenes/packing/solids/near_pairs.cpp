#include "scenes/packing/solids/near_pairs.hpp"

#include <algorithm>
#include <array>

namespace pulvis::space {
namespace {

constexpr int most_cells = 64;  // along an axis

// Cells as wide as two largest spheres plus the range: neighbours are in the same or adjacent cells.
class BallGrid {
 public:
  BallGrid(const std::vector<Ball>& balls, double range) : balls_(balls), range_(range) {
    low_ = balls[0].centre;
    V3 high = low_;
    double largest = 0;
    for (const Ball& ball : balls) {
      const V3& c = ball.centre;
      low_ = {std::min(low_.x, c.x), std::min(low_.y, c.y), std::min(low_.z, c.z)};
      high = {std::max(high.x, c.x), std::max(high.y, c.y), std::max(high.z, c.z)};
      largest = std::max(largest, ball.radius);
    }
    const V3 size = high - low_;
    edge_ = std::max(2 * largest + range, std::max({size.x, size.y, size.z}) / most_cells);
    columns_ = steps(size.x) + 1;
    rows_ = steps(size.y) + 1;
    cells_.resize(static_cast<std::size_t>(columns_ * rows_ * (steps(size.z) + 1)));
    for (std::size_t i = 0; i < balls.size(); ++i)
      cells_[cell_of(balls[i].centre)].push_back(static_cast<std::int32_t>(i));
  }

  std::vector<std::pair<std::int32_t, std::int32_t>> pairs() {
    const int layers = static_cast<int>(cells_.size()) / (columns_ * rows_);
    for (int z = 0; z < layers; ++z)
      for (int y = 0; y < rows_; ++y)
        for (int x = 0; x < columns_; ++x) pairs_of_cell(x, y, z, layers);
    return std::move(pairs_);
  }

 private:
  int steps(double length) const { return static_cast<int>(length / edge_); }
  std::size_t number(int x, int y, int z) const {
    return static_cast<std::size_t>((z * rows_ + y) * columns_ + x);
  }
  std::size_t cell_of(const V3& p) const {
    const V3 from_low = p - low_;
    return number(steps(from_low.x), steps(from_low.y), steps(from_low.z));
  }

  // Pairs within the cell, and with the thirteen of its neighbours that follow it.
  void pairs_of_cell(int x, int y, int z, int layers) {
    const auto& own = cells_[number(x, y, z)];
    for (std::size_t i = 0; i < own.size(); ++i)
      for (std::size_t k = i + 1; k < own.size(); ++k) compare(own[i], own[k]);
    for (int step = 14; step < 27; ++step) {
      const int i = x + step % 3 - 1, k = y + step / 3 % 3 - 1, l = z + step / 9 - 1;
      if (i < 0 || k < 0 || i >= columns_ || k >= rows_ || l >= layers) continue;
      for (const std::int32_t a : own)
        for (const std::int32_t b : cells_[number(i, k, l)]) compare(a, b);
    }
  }

  void compare(std::int32_t a, std::int32_t b) {
    const Ball &p = balls_[static_cast<std::size_t>(a)], &q = balls_[static_cast<std::size_t>(b)];
    const V3 apart = q.centre - p.centre;
    const double reach = p.radius + q.radius + range_;
    if (dot(apart, apart) < reach * reach) pairs_.emplace_back(std::min(a, b), std::max(a, b));
  }

  const std::vector<Ball>& balls_;
  double range_, edge_ = 0;
  V3 low_;
  int columns_ = 1, rows_ = 1;
  std::vector<std::vector<std::int32_t>> cells_;
  std::vector<std::pair<std::int32_t, std::int32_t>> pairs_;
};

}  // namespace

std::vector<std::pair<std::int32_t, std::int32_t>> near_pairs(const std::vector<Ball>& balls,
                                                              double range) {
  return balls.empty() ? std::vector<std::pair<std::int32_t, std::int32_t>>{}
                       : BallGrid(balls, range).pairs();
}

}  // namespace pulvis::space
