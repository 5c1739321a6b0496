#include "scenes/packing/outlines/container.hpp"

#include <algorithm>
#include <cmath>

namespace pulvis {
namespace {

using portable::cross;
using portable::dot;
using portable::Turn;
using portable::V2;

constexpr V2 normals[4] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
constexpr double max_turn = 0.5;  // rad, in one correction

// Cells as wide as two largest particles plus the range; each is checked against itself and four of its neighbours. In
// a periodic cell, particles are moved into it, and the neighbours beyond each border are those of the opposite one.
class OutlineGrid {
 public:
  OutlineGrid(const Container& container, double height, const std::vector<RigidPose>& poses,
              const std::vector<double>& radii, double range)
      : container_(container), height_(height), radii_(radii), range_(range), home_(poses.size()) {
    const double edge = 2 * std::ranges::max(radii) + range;
    columns_ = static_cast<int>(container.width / edge);
    rows_ = static_cast<int>(height / edge);
    for (std::size_t i = 0; i < poses.size(); ++i) at_.push_back(at_home(poses[i].at, home_[i]));
  }

  std::vector<NearPair> pairs() {
    // The neighbours of a cell are then not all different: every image of every pair is checked.
    if (container_.periodic && (columns_ < 3 || rows_ < 3)) {
      all_images();
    } else {
      columns_ = std::max(1, columns_);
      rows_ = std::max(1, rows_);
      fill();
      for (int r = 0; r < rows_; ++r)
        for (int c = 0; c < columns_; ++c) pairs_of_cell(c, r);
    }
    return std::move(pairs_);
  }

 private:
  struct Home {  // periods that move a particle into the cell
    std::int32_t x = 0, y = 0;
  };

  V2 at_home(const V2& p, Home& home) const {
    if (!container_.periodic) return p;
    home = {-static_cast<std::int32_t>(std::floor(p.x / container_.width)),
            -static_cast<std::int32_t>(std::floor(p.y / height_))};
    return p + V2{home.x * container_.width, home.y * height_};
  }

  const std::vector<std::int32_t>& cell(int column, int row) const {
    return cells_[static_cast<std::size_t>(row * columns_ + column)];
  }

  void fill() {
    const auto place = [](double x, double extent, int count) {
      return std::clamp(static_cast<int>(x / extent * count), 0, count - 1);
    };
    cells_.resize(static_cast<std::size_t>(columns_ * rows_));
    for (std::size_t i = 0; i < at_.size(); ++i) {
      const int c = place(at_[i].x, container_.width, columns_),
                r = place(at_[i].y, height_, rows_);
      cells_[static_cast<std::size_t>(r * columns_ + c)].push_back(static_cast<std::int32_t>(i));
    }
  }

  void all_images() {
    const auto count = static_cast<std::int32_t>(at_.size());
    for (std::int32_t a = 0; a < count; ++a)
      for (std::int32_t b = a; b < count; ++b)
        for (std::int32_t x = -1; x <= 1; ++x)
          for (std::int32_t y = -1; y <= 1; ++y)
            if (a != b || x > 0 || (x == 0 && y > 0)) compare(a, b, x, y);
  }

  void pairs_of_cell(int c, int r) {
    const auto& own = cell(c, r);
    for (std::size_t i = 0; i < own.size(); ++i)
      for (std::size_t k = i + 1; k < own.size(); ++k) compare(own[i], own[k], 0, 0);
    constexpr int steps[4][2] = {{1, 0}, {-1, 1}, {0, 1}, {1, 1}};
    for (const auto& step : steps) {
      const int x = c + step[0], y = r + step[1];
      const int over_x = x < 0 ? -1 : x >= columns_ ? 1 : 0, over_y = y >= rows_ ? 1 : 0;
      if (!container_.periodic && (over_x != 0 || over_y != 0)) continue;
      for (const std::int32_t i : own)
        for (const std::int32_t k : cell(x - over_x * columns_, y - over_y * rows_))
          compare(i, k, over_x, over_y);
    }
  }

  void compare(std::int32_t a, std::int32_t b, std::int32_t x, std::int32_t y) {
    const auto i = static_cast<std::size_t>(a), k = static_cast<std::size_t>(b);
    const V2 apart = at_[k] + V2{x * container_.width, y * height_} - at_[i];
    const double reach = radii_[i] + radii_[k] + range_;
    if (dot(apart, apart) < reach * reach)
      pairs_.push_back({a, b, home_[k].x + x - home_[i].x, home_[k].y + y - home_[i].y});
  }

  const Container& container_;
  double height_;
  const std::vector<double>& radii_;
  double range_;
  int columns_ = 1, rows_ = 1;
  std::vector<Home> home_;
  std::vector<V2> at_;
  std::vector<std::vector<std::int32_t>> cells_;
  std::vector<NearPair> pairs_;
};

}  // namespace

std::optional<RigidTouch> wall_touch(const Container& container, double height, int wall,
                                     const RigidShape& shape, const RigidPose& pose, double range) {
  const V2 n = normals[wall];
  const double offsets[4] = {0, -container.width, 0, -height}, offset = offsets[wall];
  if (dot(n, pose.at) - offset >= shape.reach + range) return std::nullopt;
  std::optional<RigidTouch> deepest;
  for (const RigidPiece& piece : shape.pieces)
    for (const V2 corner : piece.corners) {
      const V2 point = pose.at + pose.turn * corner;
      const double gap = dot(n, point) - offset - piece.radius;
      if (gap < (deepest ? deepest->gap : range)) deepest = {point, n, gap};
    }
  return deepest;
}

std::vector<NearPair> near_pairs(const Container& container, double height,
                                 const std::vector<RigidPose>& poses,
                                 const std::vector<double>& radii, double range) {
  return OutlineGrid(container, height, poses, radii, range).pairs();
}

RigidPose random_pose(const Container& container, double height, const RigidShape& shape,
                      portable::Random& random) {
  const V2 direction = random.direction();
  const double edge =
      container.periodic ? 0 : std::min({shape.reach, container.width / 2, height / 2});
  const double x = random.between(edge, container.width - edge);
  return {{x, random.between(edge, height - edge)}, {direction.x, direction.y}};
}

RigidPose shaken(const RigidPose& pose, const RigidShape& shape, double displacement,
                 portable::Random& random) {
  const double x = random.between(-displacement, displacement),
               y = random.between(-displacement, displacement);
  const double turn = random.between(-displacement, displacement) / shape.diameter;
  return {pose.at + shape.diameter * V2{x, y}, portable::turned(pose.turn, turn)};
}

RigidPose carried_on(const RigidPose& pose, const RigidPose& before, const RigidShape&,
                     double share) {
  const Turn now = pose.turn, then = before.turn;
  return {pose.at + share * (pose.at - before.at),
          portable::turned(now, share * (now.s * then.c - now.c * then.s) / 2)};
}

RigidPose corrected(const RigidPose& pose, const RigidShape& shape, const V2& arm,
                    const V2& correction) {
  const V2 at = pose.at + (1 / shape.content) * correction;
  const double turn = cross(arm, correction) / (shape.content * shape.gyration);
  if (turn == 0) return {at, pose.turn};
  return {at, portable::turned(pose.turn, std::clamp(turn, -max_turn, max_turn) / 2)};
}

double leverage(const RigidShape& shape, const V2& arm, const V2& normal) {
  const double turn = cross(arm, normal);
  return turn * turn / shape.gyration;
}

}  // namespace pulvis
