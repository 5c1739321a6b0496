// Position-based dynamics of rigid bodies (Mueller et al. 2007; Jakobsen 2001): one overlap after another is removed by
// moving and rotating its two particles, in proportion to their mobilities, as an impulse at the contact would. Sweeps over
// all pairs, alternately forwards and backwards, are Gauss-Seidel iterations towards a state without overlaps. No friction.
#include "scenes/packing/rigid_powder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pulvis {
namespace {

constexpr double list_range = 0.25;       // of a mean diameter: closer pairs are listed
constexpr double joint_share = 1.2;       // of the overlaps at two particles' contacts, shared out
constexpr double max_displacement = 0.2;  // of a particle in one correction
constexpr double gap_range = 0.5;         // of a diameter: farther particles are not neighbours
constexpr double kept_speed =
    0.95;  // from the last sweep; without it, displacements spread diffusively
constexpr double kept_margin = 0.1;  // of two margins, which a relaxed contact keeps

template <class Pair>
std::array<std::size_t, 2> both_of(const Pair& pair) {
  return {static_cast<std::size_t>(pair.a), static_cast<std::size_t>(pair.b)};
}

}  // namespace

// ---- what differs by dimension -----------------------------------------------------------------------
template <>
RigidPose RigidPowder<TwoD>::second_of(const NearPair& pair) const {
  RigidPose pose = poses_[static_cast<std::size_t>(pair.b)];
  pose.at = pose.at + portable::V2{pair.x * container_.width, pair.y * height_};
  return pose;
}

template <>
space::RigidPose RigidPowder<ThreeD>::second_of(const space::NearPair& pair) const {
  space::RigidPose pose = poses_[static_cast<std::size_t>(pair.b)];
  if (container_.periodic) pose.at = pose.at + shift_of(container_, height_, pair.periods);
  return pose;
}

template <>
std::span<const RigidTouch> RigidPowder<TwoD>::touches_of(NearPair& pair, double range) {
  const auto [a, b] = both_of(pair);
  return contacts_.between(shape(a), poses_[a], shape(b), second_of(pair), range);
}

template <>
std::span<const space::RigidTouch> RigidPowder<ThreeD>::touches_of(space::NearPair& pair,
                                                                   double range) {
  const auto [a, b] = both_of(pair);
  const space::RigidPose second = second_of(pair);
  contacts_ = space::RigidPair(shape(a), poses_[a], shape(b), second).touch(range, pair.normal);
  return contacts_ ? std::span<const space::RigidTouch>(&*contacts_, 1)
                   : std::span<const space::RigidTouch>();
}

template <>
std::optional<double> RigidPowder<TwoD>::gap_of(NearPair& pair, double range) {
  const auto touches = touches_of(pair, range);
  if (touches.empty()) return std::nullopt;
  return std::ranges::min_element(touches, {}, &RigidTouch::gap)->gap;
}

// (The gap of a touch is a lower bound.)
template <>
std::optional<double> RigidPowder<ThreeD>::gap_of(space::NearPair& pair, double range) {
  const auto touches = touches_of(pair, range);
  if (touches.empty()) return std::nullopt;
  const auto [a, b] = both_of(pair);
  const space::RigidPose second = second_of(pair);
  return space::RigidPair(shape(a), poses_[a], shape(b), second).distance(touches[0].normal);
}

// For each wall the deepest corner, then the deepest again: for a flat side on a wall, its other end. All walls start from
// the same pose, while solids take one wall after the other: packings of either kind keep their bits.
template <>
double RigidPowder<TwoD>::push_from_walls(std::size_t i) {
  constexpr int rounds = 2;
  double worst = 0;
  for (int round = 0; round < rounds; ++round) {
    std::array<std::optional<RigidTouch>, 4> touches;
    for (int wall = 0; wall < walls_of(container_); ++wall)
      touches[static_cast<std::size_t>(wall)] = at_wall(i, wall, margin_);
    const portable::V2 centre = poses_[i].at;
    for (const auto& touch : touches) {
      if (!touch) continue;
      const double overlap = push_from_wall(i, *touch, centre);
      if (round == 0) worst = std::max(worst, overlap);
    }
  }
  return worst;
}

template <>
double RigidPowder<ThreeD>::push_from_walls(std::size_t i) {
  const int rounds = shape(i).is_ball() ? 1 : 3;
  double worst = 0;
  for (int wall = 0; wall < walls_of(container_); ++wall)
    for (int round = 0; round < rounds; ++round) {
      const auto touch = at_wall(i, wall, margin_);
      if (!touch) break;
      worst = std::max(worst, push_from_wall(i, *touch, poses_[i].at));
    }
  return worst;
}

// ---- the same for both -------------------------------------------------------------------------------
template <class D>
RigidPowder<D>::RigidPowder(const std::vector<Shape>& shapes, std::vector<int> shape_of,
                            const Container& container, double margin)
    : shapes_(shapes), shape_of_(std::move(shape_of)), container_(container), margin_(margin) {
  poses_.resize(shape_of_.size());
}

template <class D>
void RigidPowder<D>::scatter(double height, portable::Random& random) {
  height_ = height;
  for (std::size_t i = 0; i < poses_.size(); ++i)
    poses_[i] = random_pose(container_, height, shape(i), random);
  listed_.clear();
}

template <class D>
void RigidPowder<D>::squeeze(double height) {
  for (Pose& pose : poses_) height_of(pose) *= height / height_;
  height_ = height;
}

template <class D>
void RigidPowder<D>::shake(double displacement, portable::Random& random) {
  for (std::size_t i = 0; i < poses_.size(); ++i)
    poses_[i] = shaken(poses_[i], shape(i), displacement, random);
}

template <class D>
void RigidPowder<D>::restore(const std::vector<Pose>& poses, double height) {
  poses_ = poses;
  height_ = height;
  listed_.clear();
}

template <class D>
bool RigidPowder<D>::relax(int max_sweeps) {
  const double allowed = 2 * margin_ * (1 - kept_margin);
  before_ = poses_;
  std::vector<Pose> start;
  for (int i = 0; i < max_sweeps; ++i) {
    start = poses_;
    if (i > 0) drift();
    before_.swap(start);
    if (sweep() < allowed && min_gap() >= 2 * margin_ * kept_margin) return true;
  }
  return false;
}

// Particles continue to move as in the last sweep, apart from a fraction that is lost.
template <class D>
void RigidPowder<D>::drift() {
  for (std::size_t i = 0; i < poses_.size(); ++i)
    poses_[i] = carried_on(poses_[i], before_[i], shape(i), kept_speed);
}

template <class D>
bool RigidPowder<D>::lists_hold() const {
  if (listed_.empty()) return false;
  constexpr double displacement = list_range / 2;
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    const Vector moved = poses_[i].at - listed_[i].at;
    if (dot(moved, moved) > displacement * displacement) return false;
  }
  return true;
}

template <class D>
void RigidPowder<D>::find_pairs(double range) {
  std::vector<double> reaches;
  for (std::size_t i = 0; i < poses_.size(); ++i) reaches.push_back(shape(i).reach);
  pairs_ = near_pairs(container_, height_, poses_, reaches, range);
  listed_ = poses_;
}

template <class D>
double RigidPowder<D>::sweep() {
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

template <class D>
void RigidPowder<D>::correct(std::size_t i, const Vector& arm, const Vector& correction) {
  poses_[i] = corrected(poses_[i], shape(i), arm, correction);
}

template <class D>
double RigidPowder<D>::push(Pair& pair) {
  const auto [a, b] = both_of(pair);
  const Shape &of_a = shape(a), &of_b = shape(b);
  const Vector centre_a = poses_[a].at, centre_b = second_of(pair).at, apart = centre_b - centre_a;
  const double reach = of_a.reach + of_b.reach + 2 * margin_;
  if (dot(apart, apart) >= reach * reach) return 0;
  const auto touches = touches_of(pair, 2 * margin_);
  const double share = touches.size() > 1 ? joint_share / static_cast<double>(touches.size()) : 1;
  double worst = 0;
  for (const Touch& touch : touches) {
    const double overlap = 2 * margin_ - touch.gap;
    worst = std::max(worst, overlap);
    const Vector arm_a = touch.point - centre_a, arm_b = touch.point - centre_b;
    const double mobility = (1 + leverage(of_a, arm_a, touch.normal)) / of_a.content +
                            (1 + leverage(of_b, arm_b, touch.normal)) / of_b.content;
    const double strength = share * std::min(overlap, max_displacement) / mobility;
    correct(a, arm_a, -strength * touch.normal);
    correct(b, arm_b, strength * touch.normal);
  }
  return worst;
}

template <class D>
auto RigidPowder<D>::at_wall(std::size_t i, int wall, double range) const -> std::optional<Touch> {
  return wall_touch(container_, height_, wall, shape(i), poses_[i], range);
}

template <class D>
double RigidPowder<D>::push_from_wall(std::size_t i, const Touch& touch, const Vector& centre) {
  const double overlap = margin_ - touch.gap;
  const Vector arm = touch.point - centre;
  const double strength = overlap * shape(i).content / (1 + leverage(shape(i), arm, touch.normal));
  correct(i, arm, strength * touch.normal);
  return overlap;
}

template <class D>
double RigidPowder<D>::min_gap() {
  if (!lists_hold()) find_pairs(list_range + 2 * margin_);
  double minimum = std::numeric_limits<double>::max();
  for (Pair& pair : pairs_)
    for (const Touch& touch : touches_of(pair, 2 * margin_)) minimum = std::min(minimum, touch.gap);
  for (std::size_t i = 0; i < poses_.size(); ++i)
    for (int wall = 0; wall < walls_of(container_); ++wall)
      if (const auto touch = at_wall(i, wall, margin_)) minimum = std::min(minimum, 2 * touch->gap);
  return minimum;
}

template <class D>
std::vector<std::array<double, 3>> RigidPowder<D>::near_gaps(double touching, int& touches) {
  std::vector<std::array<double, 3>> gaps(poses_.size(), {gap_range, gap_range, gap_range});
  double widest = 0;
  for (const Shape& s : shapes_) widest = std::max(widest, s.diameter);
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
    const auto gap = gap_of(pair, range);
    if (!gap) continue;
    const auto [a, b] = both_of(pair);
    note(a, *gap);
    note(b, *gap);
    if (*gap < touching * std::min(shape(a).diameter, shape(b).diameter)) ++touches;
  }
  for (std::size_t i = 0; i < poses_.size(); ++i)
    for (int wall = 0; wall < walls_of(container_); ++wall)
      if (const auto touch = at_wall(i, wall, range)) note(i, touch->gap);
  listed_.clear();  // these lists are too long to use
  return gaps;
}

template class RigidPowder<TwoD>;
template class RigidPowder<ThreeD>;

}  // namespace pulvis
