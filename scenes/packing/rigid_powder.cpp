// Position-based dynamics of rigid bodies (Mueller et al. 2007; Jakobsen 2001): one overlap after another
// is removed by moving and rotating its two particles, in proportion to their mobilities, as an impulse
// at the contact would. Sweeps over all pairs, alternately forwards and backwards, are Gauss-Seidel iterations
// towards a state without overlaps. No friction.
#include "scenes/packing/rigid_powder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pulvis {
namespace {

using portable::cross;
using portable::dot;
using portable::Turn;
using portable::V2;

constexpr double list_range = 0.25;  // of a mean diameter: closer pairs are listed
constexpr V2 tool_normals[4] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
constexpr double joint_share = 1.2;       // of the overlaps at two particles' contacts, shared out
constexpr double max_displacement = 0.2;  // of a particle in one correction
constexpr double gap_range = 0.5;         // of a diameter: farther particles are not neighbours
constexpr double kept_speed = 0.95;       // from the last sweep; without it, displacements spread diffusively
constexpr double kept_margin = 0.1;       // of two margins, which a relaxed contact keeps

}  // namespace

RigidPowder::RigidPowder(std::vector<RigidShape> shapes, std::vector<int> shape_of, double width,
                         double margin, bool periodic)
    : shapes_(std::move(shapes)),
      shape_of_(std::move(shape_of)),
      width_(width),
      margin_(margin),
      periodic_(periodic) {
  for (const RigidShape& s : shapes_) largest_reach_ = std::max(largest_reach_, s.reach);
  poses_.resize(shape_of_.size());
}

void RigidPowder::scatter(double height, portable::Random& random) {
  height_ = height;
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    const V2 direction = random.direction();
    const double edge = periodic_ ? 0 : std::min({shape(i).reach, width_ / 2, height_ / 2});
    const double x = random.between(edge, width_ - edge);
    poses_[i] = {{x, random.between(edge, height_ - edge)}, {direction.x, direction.y}};
  }
  listed_.clear();
}

void RigidPowder::squeeze(double height) {
  for (RigidPose& pose : poses_) pose.at.y *= height / height_;
  height_ = height;
}

void RigidPowder::shake(double displacement, portable::Random& random) {
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    const double x = random.between(-displacement, displacement),
                 y = random.between(-displacement, displacement);
    const double turn = random.between(-displacement, displacement) / shape(i).diameter;
    poses_[i].at = poses_[i].at + shape(i).diameter * V2{x, y};
    poses_[i].turn = portable::turned(poses_[i].turn, turn);
  }
}

void RigidPowder::restore(const std::vector<RigidPose>& poses, double height) {
  poses_ = poses;
  height_ = height;
  listed_.clear();
}

bool RigidPowder::relax(int max_sweeps) {
  const double allowed = 2 * margin_ * (1 - kept_margin);
  before_ = poses_;
  for (int i = 0; i < max_sweeps; ++i) {
    const std::vector<RigidPose> start = poses_;
    if (i > 0) drift();
    before_ = start;
    if (sweep() < allowed && min_gap() >= 2 * margin_ * kept_margin) return true;
  }
  return false;
}

// Particles continue to move as in the last sweep, apart from a fraction that is lost.
void RigidPowder::drift() {
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    const Turn now = poses_[i].turn, then = before_[i].turn;
    poses_[i].at = poses_[i].at + kept_speed * (poses_[i].at - before_[i].at);
    poses_[i].turn = portable::turned(now, kept_speed * (now.s * then.c - now.c * then.s) / 2);
  }
}

bool RigidPowder::lists_hold() const {
  if (listed_.empty()) return false;
  constexpr double displacement = list_range / 2;
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    const V2 moved = poses_[i].at - listed_[i].at;
    if (dot(moved, moved) > displacement * displacement) return false;
  }
  return true;
}

// Cells as wide as two largest particles plus the range; each is checked against itself and four of its
// neighbours.
void RigidPowder::find_pairs(double range) {
  if (periodic_) return find_pairs_in_cell(range);
  const double cell = 2 * largest_reach_ + range;
  const int columns = std::max(1, static_cast<int>(width_ / cell));
  const int rows = std::max(1, static_cast<int>(height_ / cell));
  const auto place = [](double x, double extent, int count) {
    return std::clamp(static_cast<int>(x / extent * count), 0, count - 1);
  };
  std::vector<std::vector<std::int32_t>> cells(static_cast<std::size_t>(columns * rows));
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    const int c = place(poses_[i].at.x, width_, columns), r = place(poses_[i].at.y, height_, rows);
    cells[static_cast<std::size_t>(r * columns + c)].push_back(static_cast<std::int32_t>(i));
  }
  pairs_.clear();
  const auto compare = [&](std::int32_t a, std::int32_t b) {
    const auto i = static_cast<std::size_t>(a), k = static_cast<std::size_t>(b);
    const V2 apart = poses_[k].at - poses_[i].at;
    const double reach = shape(i).reach + shape(k).reach + range;
    if (dot(apart, apart) < reach * reach) pairs_.push_back({a, b});
  };
  constexpr int steps[4][2] = {{1, 0}, {-1, 1}, {0, 1}, {1, 1}};
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) {
      const auto& own = cells[static_cast<std::size_t>(r * columns + c)];
      for (std::size_t i = 0; i < own.size(); ++i)
        for (std::size_t k = i + 1; k < own.size(); ++k) compare(own[i], own[k]);
      for (const auto& step : steps) {
        const int x = c + step[0], y = r + step[1];
        if (x < 0 || x >= columns || y >= rows) continue;
        for (const std::int32_t i : own)
          for (const std::int32_t k : cells[static_cast<std::size_t>(y * columns + x)])
            compare(i, k);
      }
    }
  listed_ = poses_;
}

// The same for all particles moved into the cell, with the grid cells beyond each border. If the cell is narrower than
// three of those, every image of every pair is checked.
void RigidPowder::find_pairs_in_cell(double range) {
  const double cell = 2 * largest_reach_ + range;
  const int columns = static_cast<int>(width_ / cell), rows = static_cast<int>(height_ / cell);
  std::vector<Home> home(poses_.size());
  std::vector<V2> at(poses_.size());
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    const V2 p = poses_[i].at;
    home[i] = {-static_cast<std::int32_t>(std::floor(p.x / width_)),
               -static_cast<std::int32_t>(std::floor(p.y / height_))};
    at[i] = p + V2{home[i].x * width_, home[i].y * height_};
  }
  pairs_.clear();
  const auto compare = [&](std::int32_t a, std::int32_t b, std::int32_t x, std::int32_t y) {
    const auto i = static_cast<std::size_t>(a), k = static_cast<std::size_t>(b);
    const V2 apart = at[k] + V2{x * width_, y * height_} - at[i];
    const double reach = shape(i).reach + shape(k).reach + range;
    if (dot(apart, apart) < reach * reach)
      pairs_.push_back({a, b, home[k].x + x - home[i].x, home[k].y + y - home[i].y});
  };
  listed_ = poses_;
  const auto count = static_cast<std::int32_t>(poses_.size());
  if (columns < 3 || rows < 3) {
    for (std::int32_t a = 0; a < count; ++a)
      for (std::int32_t b = a; b < count; ++b)
        for (std::int32_t x = -1; x <= 1; ++x)
          for (std::int32_t y = -1; y <= 1; ++y)
            if (a != b || x > 0 || (x == 0 && y > 0)) compare(a, b, x, y);
    return;
  }
  std::vector<std::vector<std::int32_t>> cells(static_cast<std::size_t>(columns * rows));
  const auto place = [](double x, double extent, int cells_along) {
    return std::clamp(static_cast<int>(x / extent * cells_along), 0, cells_along - 1);
  };
  for (std::int32_t i = 0; i < count; ++i) {
    const V2 p = at[static_cast<std::size_t>(i)];
    const int c = place(p.x, width_, columns), r = place(p.y, height_, rows);
    cells[static_cast<std::size_t>(r * columns + c)].push_back(i);
  }
  constexpr int steps[4][2] = {{1, 0}, {-1, 1}, {0, 1}, {1, 1}};
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) {
      const auto& own = cells[static_cast<std::size_t>(r * columns + c)];
      for (std::size_t i = 0; i < own.size(); ++i)
        for (std::size_t k = i + 1; k < own.size(); ++k) compare(own[i], own[k], 0, 0);
      for (const auto& step : steps) {
        const int x = c + step[0], y = r + step[1];
        const int over_x = x < 0 ? -1 : x >= columns ? 1 : 0, over_y = y >= rows ? 1 : 0;
        const int there = (y - over_y * rows) * columns + x - over_x * columns;
        for (const std::int32_t i : own)
          for (const std::int32_t k : cells[static_cast<std::size_t>(there)])
            compare(i, k, over_x, over_y);
      }
    }
}

double RigidPowder::sweep() {
  if (!lists_hold()) find_pairs(list_range + 2 * margin_);
  double worst = 0;
  if (sweeps_++ % 2 == 0) {
    for (const Pair& pair : pairs_) worst = std::max(worst, push(pair));
    for (std::size_t i = 0; i < poses_.size(); ++i) worst = std::max(worst, push_from_tools(i));
  } else {
    for (std::size_t i = poses_.size(); i-- > 0;) worst = std::max(worst, push_from_tools(i));
    for (std::size_t p = pairs_.size(); p-- > 0;) worst = std::max(worst, push(pairs_[p]));
  }
  return worst;
}

// Moves particle i like an impulse along `correction` at `arm` from its centroid, whose magnitude is the length of
// `correction` in units of area.
void RigidPowder::correct(std::size_t i, V2 arm, V2 correction) {
  const RigidShape& s = shape(i);
  poses_[i].at = poses_[i].at + (1 / s.area) * correction;
  const double turn = cross(arm, correction) / (s.area * s.gyration);
  if (turn != 0) poses_[i].turn = portable::turned(poses_[i].turn, std::clamp(turn, -0.5, 0.5) / 2);
}

double RigidPowder::push(const Pair& pair) {
  const auto a = static_cast<std::size_t>(pair.a), b = static_cast<std::size_t>(pair.b);
  const RigidShape &of_a = shape(a), &of_b = shape(b);
  const RigidPose there = image(pair);
  const V2 apart = there.at - poses_[a].at;
  const double reach = of_a.reach + of_b.reach + 2 * margin_;
  if (dot(apart, apart) >= reach * reach) return 0;
  const auto& touches = contacts_.between(of_a, poses_[a], of_b, there, 2 * margin_);
  double worst = 0;
  const V2 centre_a = poses_[a].at, centre_b = there.at;
  const double share = touches.size() > 1 ? joint_share / static_cast<double>(touches.size()) : 1;
  for (const RigidTouch& touch : touches) {
    const double overlap = 2 * margin_ - touch.gap;
    worst = std::max(worst, overlap);
    const V2 arm_a = touch.point - centre_a, arm_b = touch.point - centre_b;
    const double turn_a = cross(arm_a, touch.normal), turn_b = cross(arm_b, touch.normal);
    const double mobility = (1 + turn_a * turn_a / of_a.gyration) / of_a.area +
                            (1 + turn_b * turn_b / of_b.gyration) / of_b.area;
    const double strength = share * std::min(overlap, max_displacement) / mobility;
    correct(a, arm_a, -strength * touch.normal);
    correct(b, arm_b, strength * touch.normal);
  }
  return worst;
}

void RigidPowder::touches_with_tools(std::size_t i, double range,
                                     std::vector<RigidTouch>& touches) const {
  touches.clear();
  if (periodic_) return;
  const RigidShape& s = shape(i);
  const RigidPose& pose = poses_[i];
  const double reach = s.reach + range;
  const double beyond[4] = {0, -width_, 0, -height_};
  for (int tool = 0; tool < 4; ++tool) {
    const V2 n = tool_normals[tool];
    if (dot(n, pose.at) - beyond[tool] >= reach) continue;
    for (const RigidPiece& piece : s.pieces)
      for (const V2 corner : piece.corners) {
        const V2 point = pose.at + pose.turn * corner;
        const double gap = dot(n, point) - beyond[tool] - piece.radius;
        if (gap < range) touches.push_back({point, n, gap});
      }
  }
}

// For each tool, the deepest corner, then the deepest again: for a flat side on a tool, its other end.
double RigidPowder::push_from_tools(std::size_t i) {
  double worst = 0;
  for (int round = 0; round < 2; ++round) {
    touches_with_tools(i, margin_, tool_touches_);
    if (tool_touches_.empty()) return worst;
    const RigidShape& s = shape(i);
    const V2 centre = poses_[i].at;
    for (const V2 n : tool_normals) {
      const RigidTouch* deepest = nullptr;
      for (const RigidTouch& touch : tool_touches_)
        if (touch.normal.x == n.x && touch.normal.y == n.y &&
            (deepest == nullptr || touch.gap < deepest->gap))
          deepest = &touch;
      if (deepest == nullptr) continue;
      const double overlap = margin_ - deepest->gap;
      if (round == 0) worst = std::max(worst, overlap);
      const V2 arm = deepest->point - centre;
      const double turn = cross(arm, n);
      const double strength = overlap * s.area / (1 + turn * turn / s.gyration);
      correct(i, arm, strength * n);
    }
  }
  return worst;
}

double RigidPowder::min_gap() {
  if (!lists_hold()) find_pairs(list_range + 2 * margin_);
  double minimum = std::numeric_limits<double>::max();
  for (const Pair& pair : pairs_) {
    const auto a = static_cast<std::size_t>(pair.a), b = static_cast<std::size_t>(pair.b);
    for (const RigidTouch& touch :
         contacts_.between(shape(a), poses_[a], shape(b), image(pair), 2 * margin_))
      minimum = std::min(minimum, touch.gap);
  }
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    touches_with_tools(i, margin_, tool_touches_);
    for (const RigidTouch& touch : tool_touches_) minimum = std::min(minimum, 2 * touch.gap);
  }
  return minimum;
}

std::vector<std::array<double, 3>> RigidPowder::near_gaps(double touching, int& touches) {
  std::vector<std::array<double, 3>> gaps(poses_.size(), {gap_range, gap_range, gap_range});
  double widest = 0;
  for (const RigidShape& s : shapes_) widest = std::max(widest, s.diameter);
  find_pairs(gap_range * widest);
  const auto note = [&](std::size_t i, double gap) {
    const double share = std::max(gap / shape(i).diameter, 0.0);
    auto& own = gaps[i];
    if (share >= own[2]) return;
    own[2] = share;
    std::sort(own.begin(), own.end());
  };
  for (const Pair& pair : pairs_) {
    const auto a = static_cast<std::size_t>(pair.a), b = static_cast<std::size_t>(pair.b);
    double minimum = std::numeric_limits<double>::max();
    for (const RigidTouch& touch :
         contacts_.between(shape(a), poses_[a], shape(b), image(pair), gap_range * widest))
      minimum = std::min(minimum, touch.gap);
    note(a, minimum);
    note(b, minimum);
    if (minimum < touching * std::min(shape(a).diameter, shape(b).diameter)) ++touches;
  }
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    touches_with_tools(i, gap_range * widest, tool_touches_);
    for (const V2 n : tool_normals) {
      double minimum = std::numeric_limits<double>::max();
      for (const RigidTouch& touch : tool_touches_)
        if (touch.normal.x == n.x && touch.normal.y == n.y) minimum = std::min(minimum, touch.gap);
      note(i, minimum);
    }
  }
  listed_.clear();  // these lists are too long to use
  return gaps;
}

}  // namespace pulvis
