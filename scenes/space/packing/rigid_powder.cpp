// Position-based dynamics of rigid bodies (Mueller et al. 2007; Jakobsen 2001): one overlap after another is removed by
// moving and rotating its two particles, in proportion to their mobilities, as an impulse at the contact would. Sweeps over
// all pairs, alternately forwards and backwards, are Gauss-Seidel iterations towards a state without overlaps. No friction.
#include "scenes/space/packing/rigid_powder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scenes/space/packing/near_pairs.hpp"

namespace pulvis::space {
namespace {

constexpr double list_range = 0.25;       // of a mean diameter: closer pairs are listed
constexpr double max_displacement = 0.2;  // of a particle in one correction
constexpr double max_turn = 0.25;         // half of the angle, rad
constexpr double gap_range = 0.5;         // of a diameter: farther particles are not neighbours
constexpr double kept_speed = 0.95;       // from the last sweep; without it, displacements spread diffusively
constexpr double kept_margin = 0.1;       // of two margins, which a relaxed contact keeps
constexpr int wall_rounds = 3;            // for a particle that lies flat on a wall

V3 random_vector(portable::Random& random, double size) {
  const double x = random.between(-size, size), y = random.between(-size, size);
  return {x, y, random.between(-size, size)};
}

// Uniform over all rotations: a point in the unit ball in four dimensions, redrawn if too close to its centre.
Turn random_turn(portable::Random& random) {
  for (;;) {
    const double w = random.between(-1, 1);
    const V3 v = random_vector(random, 1);
    const double square = w * w + dot(v, v);
    if (square < 1e-4 || square > 1) continue;
    const double share = 1 / std::sqrt(square);
    return {share * w, share * v.x, share * v.y, share * v.z};
  }
}

V3 random_place(const Container& container, double height, double edge, portable::Random& random) {
  const auto along = [&](double size) {
    const double off = std::min(edge, size / 2);
    return random.between(off, size - off);
  };
  if (!container.round()) {
    const double x = along(container.width), y = along(container.depth);
    return {x, y, along(height)};
  }
  const double most = std::max(container.radius - edge, 0.0);
  for (;;) {
    const double x = random.between(-most, most), y = random.between(-most, most);
    if (x * x + y * y <= most * most) return {x, y, along(height)};
  }
}

}  // namespace

RigidPowder::RigidPowder(const std::vector<RigidShape>& shapes, std::vector<int> shape_of,
                         const Container& container, double margin)
    : shapes_(shapes), shape_of_(std::move(shape_of)), container_(container), margin_(margin) {
  poses_.resize(shape_of_.size());
}

void RigidPowder::scatter(double height, portable::Random& random) {
  height_ = height;
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    poses_[i].at = random_place(container_, height, shape(i).diameter / 2, random);
    poses_[i].turn = random_turn(random);
  }
  listed_.clear();
}

void RigidPowder::squeeze(double height) {
  for (RigidPose& pose : poses_) pose.at.z *= height / height_;
  height_ = height;
}

void RigidPowder::shake(double displacement, portable::Random& random) {
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    poses_[i].at = poses_[i].at + shape(i).diameter * random_vector(random, displacement);
    const V3 turn = random_vector(random, displacement);
    if (!shape(i).is_ball()) poses_[i].turn = turned(poses_[i].turn, turn);
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
  std::vector<RigidPose> start;
  for (int i = 0; i < max_sweeps; ++i) {
    start = poses_;
    if (i > 0) drift();
    before_.swap(start);
    if (sweep() < allowed && min_gap() >= 2 * margin_ * kept_margin) return true;
  }
  return false;
}

// Particles continue to move as in the last sweep, apart from a fraction that is lost.
void RigidPowder::drift() {
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    const RigidPose& then = before_[i];
    poses_[i].at = poses_[i].at + kept_speed * (poses_[i].at - then.at);
    if (shape(i).is_ball()) continue;
    const Turn change = poses_[i].turn * reversed(then.turn);
    poses_[i].turn = turned(poses_[i].turn, kept_speed * V3{change.x, change.y, change.z});
  }
}

bool RigidPowder::lists_hold() const {
  if (listed_.empty()) return false;
  constexpr double displacement = list_range / 2;
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    const V3 moved = poses_[i].at - listed_[i].at;
    if (dot(moved, moved) > displacement * displacement) return false;
  }
  return true;
}

void RigidPowder::find_pairs(double range) {
  std::vector<Ball> balls;
  for (std::size_t i = 0; i < poses_.size(); ++i) balls.push_back({poses_[i].at, shape(i).reach});
  pairs_.clear();
  for (const auto& [a, b] : near_pairs(balls, range)) pairs_.push_back({a, b, {0, 0, 1}});
  listed_ = poses_;
}

double RigidPowder::sweep() {
  if (!lists_hold()) find_pairs(list_range + 2 * margin_);
  double worst = 0;
  if (sweeps_++ % 2 == 0) {
    for (Pair& pair : pairs_) worst = std::max(worst, push(pair));
    for (std::size_t i = 0; i < poses_.size(); ++i) worst = std::max(worst, push_from_walls(i));
  } else {
    for (std::size_t i = poses_.size(); i-- > 0;) worst = std::max(worst, push_from_walls(i));
    for (std::size_t p = pairs_.size(); p-- > 0;) worst = std::max(worst, push(pairs_[p]));
  }
  return worst;
}

// Moves particle i like an impulse along `correction` at `arm` from its centre, whose magnitude is the length of
// `correction` in units of volume.
void RigidPowder::correct(std::size_t i, const V3& arm, const V3& correction) {
  const RigidShape& s = shape(i);
  poses_[i].at = poses_[i].at + (1 / s.volume) * correction;
  if (s.is_ball()) return;
  const V3 half = (1 / (2 * s.volume * s.gyration)) * cross(arm, correction);
  const double size = length(half);
  if (size > 0) poses_[i].turn = turned(poses_[i].turn, std::min(1.0, max_turn / size) * half);
}

RigidPair RigidPowder::pair_of(const Pair& pair) const {
  const auto a = static_cast<std::size_t>(pair.a), b = static_cast<std::size_t>(pair.b);
  return {shape(a), poses_[a], shape(b), poses_[b]};
}

double RigidPowder::push(Pair& pair) {
  const auto a = static_cast<std::size_t>(pair.a), b = static_cast<std::size_t>(pair.b);
  const RigidShape &of_a = shape(a), &of_b = shape(b);
  const V3 apart = poses_[b].at - poses_[a].at;
  const double reach = of_a.reach + of_b.reach + 2 * margin_;
  if (dot(apart, apart) >= reach * reach) return 0;
  const auto touch = pair_of(pair).touch(2 * margin_, pair.normal);
  if (!touch) return 0;
  const double overlap = 2 * margin_ - touch->gap;
  const V3 arm_a = touch->point - poses_[a].at, arm_b = touch->point - poses_[b].at;
  const auto mobility = [&](const RigidShape& s, const V3& arm) {
    const V3 turn = cross(arm, touch->normal);
    return (1 + (s.is_ball() ? 0 : dot(turn, turn) / s.gyration)) / s.volume;
  };
  const double strength =
      std::min(overlap, max_displacement) / (mobility(of_a, arm_a) + mobility(of_b, arm_b));
  correct(a, arm_a, -strength * touch->normal);
  correct(b, arm_b, strength * touch->normal);
  return overlap;
}

// For each wall, the deepest point, then the deepest again: for a flat side on a wall, its other end.
double RigidPowder::push_from_walls(std::size_t i) {
  const RigidShape& s = shape(i);
  double worst = 0;
  for (int wall = 0; wall < walls_of(container_); ++wall)
    for (int round = 0; round < (s.is_ball() ? 1 : wall_rounds); ++round) {
      const auto touch = wall_touch(container_, height_, wall, s, poses_[i], margin_);
      if (!touch) break;
      const double overlap = margin_ - touch->gap;
      worst = std::max(worst, overlap);
      const V3 arm = touch->point - poses_[i].at, turn = cross(arm, touch->normal);
      const double mobility = 1 + (s.is_ball() ? 0 : dot(turn, turn) / s.gyration);
      correct(i, arm, (overlap * s.volume / mobility) * touch->normal);
    }
  return worst;
}

double RigidPowder::min_gap() {
  if (!lists_hold()) find_pairs(list_range + 2 * margin_);
  double minimum = std::numeric_limits<double>::max();
  for (Pair& pair : pairs_)
    if (const auto touch = pair_of(pair).touch(2 * margin_, pair.normal))
      minimum = std::min(minimum, touch->gap);
  for (std::size_t i = 0; i < poses_.size(); ++i)
    for (int wall = 0; wall < walls_of(container_); ++wall)
      if (const auto touch = wall_touch(container_, height_, wall, shape(i), poses_[i], margin_))
        minimum = std::min(minimum, 2 * touch->gap);
  return minimum;
}

std::vector<std::array<double, 3>> RigidPowder::near_gaps(double touching, int& touches) {
  std::vector<std::array<double, 3>> gaps(poses_.size(), {gap_range, gap_range, gap_range});
  double widest = 0;
  for (const RigidShape& s : shapes_) widest = std::max(widest, s.diameter);
  const double range = gap_range * widest;
  find_pairs(range);
  const auto note = [&](std::size_t i, double gap) {
    const double share = std::max(gap / shape(i).diameter, 0.0);
    auto& own = gaps[i];
    if (share >= own[2]) return;
    own[2] = share;
    std::sort(own.begin(), own.end());
  };
  for (Pair& pair : pairs_) {
    const auto a = static_cast<std::size_t>(pair.a), b = static_cast<std::size_t>(pair.b);
    const auto touch = pair_of(pair).touch(range, pair.normal);
    if (!touch) continue;
    const double gap = pair_of(pair).distance(touch->normal);
    note(a, gap);
    note(b, gap);
    if (gap < touching * std::min(shape(a).diameter, shape(b).diameter)) ++touches;
  }
  for (std::size_t i = 0; i < poses_.size(); ++i)
    for (int wall = 0; wall < walls_of(container_); ++wall)
      if (const auto touch = wall_touch(container_, height_, wall, shape(i), poses_[i], range))
        note(i, touch->gap);
  listed_.clear();
  return gaps;
}

}  // namespace pulvis::space
