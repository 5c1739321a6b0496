#include "scenes/packing/solids/rigid_contact.hpp"

#include <algorithm>
#include <utility>

namespace pulvis::space {
namespace {

constexpr double no_length = 1e-12;
constexpr int most_faces = 60;
constexpr int most_tilts = 60;
constexpr double smallest_tilt = 1e-9;

double triple(const V3& a, const V3& b, const V3& c) { return dot(cross(a, b), c); }

V3 direction_of(const V3& apart) {
  const double distance = length(apart);
  return distance > no_length ? (1 / distance) * apart : V3{0, 0, 1};
}

}  // namespace

RigidPair::Vertex RigidPair::support(const V3& n) const {
  const V3 a = turn_a_ * a_.support(turned_back(turn_a_, n));
  const V3 b = turn_b_ * b_.support(turned_back(turn_b_, -n));
  return {a - b, a};
}

double RigidPair::gap_along(const V3& normal) const {
  return dot(apart_ - support(normal).at, normal);
}

std::optional<RigidTouch> RigidPair::touch_of_balls(double range) const {
  const double reach = a_.radius + b_.radius + range, square = dot(apart_, apart_);
  if (square >= reach * reach) return std::nullopt;
  const V3 normal = direction_of(apart_);
  const double gap = std::sqrt(square) - a_.radius - b_.radius;
  return RigidTouch{from_ + (a_.radius + gap / 2) * normal, normal, gap};
}

bool RigidPair::open_portal(const V3& along, Portal& portal) const {
  portal[0] = support(along);
  V3 n = cross(portal[0].at, along);
  if (length(n) < no_length) return false;
  portal[1] = support(unit(n));
  n = cross(portal[0].at, portal[1].at);
  if (dot(n, along) < 0) {
    std::swap(portal[0], portal[1]);
    n = -n;
  }
  for (int i = 0; i < most_faces && length(n) > no_length; ++i) {
    portal[2] = support(unit(n));
    if (triple(portal[2].at, portal[0].at, along) < 0)
      portal[1] = portal[2];
    else if (triple(portal[1].at, portal[2].at, along) < 0)
      portal[0] = portal[2];
    else
      return true;
    n = cross(portal[0].at, portal[1].at);
  }
  return false;
}

// Where the ray crosses the portal, as a weighted mean of its corners.
RigidTouch RigidPair::touch_at(const V3& along, const V3& normal, double gap,
                               const Portal& p) const {
  std::array<double, 3> weight{std::max(triple(p[1].at, p[2].at, along), 0.0),
                               std::max(triple(p[2].at, p[0].at, along), 0.0),
                               std::max(triple(p[0].at, p[1].at, along), 0.0)};
  double sum = weight[0] + weight[1] + weight[2];
  if (sum <= 0) weight = {1, 0, 0}, sum = 1;
  V3 on_a, in_c;
  for (std::size_t i = 0; i < 3; ++i) {
    on_a = on_a + (weight[i] / sum) * p[i].of_a;
    in_c = in_c + (weight[i] / sum) * p[i].at;
  }
  return {from_ + on_a + 0.5 * (apart_ - in_c), normal, gap};
}

std::optional<RigidTouch> RigidPair::touch(double range, V3& normal, double flat) const {
  if (a_.is_ball() && b_.is_ball()) return touch_of_balls(range);
  if (gap_along(normal) >= range) return std::nullopt;
  const V3 along = direction_of(apart_);
  Portal portal;
  if (!open_portal(along, portal)) {
    normal = along;
    portal[1] = portal[2] = portal[0] = support(along);
    const double gap = dot(apart_ - portal[0].at, along);
    return gap < range ? std::optional(touch_at(along, along, gap, portal)) : std::nullopt;
  }
  for (int i = 0;; ++i) {
    const V3 n = cross(portal[1].at - portal[0].at, portal[2].at - portal[0].at);
    const double area = length(n);
    normal = area > no_length * no_length ? (1 / area) * n : along;
    const Vertex beyond = support(normal);
    const double gap = dot(apart_ - beyond.at, normal);
    if (gap >= range) return std::nullopt;
    if (dot(beyond.at - portal[0].at, normal) < flat || i == most_faces)
      return touch_at(along, normal, gap, portal);
    const double s0 = triple(portal[0].at, beyond.at, along),
                 s1 = triple(portal[1].at, beyond.at, along),
                 s2 = triple(portal[2].at, beyond.at, along);
    portal[s0 <= 0 && s1 >= 0 ? 2 : s1 <= 0 && s2 >= 0 ? 0 : 1] = beyond;
  }
}

// Steepest ascent of the gap on the unit sphere; a step without gain is halved.
double RigidPair::distance(V3 normal) const {
  if (a_.is_ball() && b_.is_ball()) return length(apart_) - a_.radius - b_.radius;
  V3 out = apart_ - support(normal).at;
  double gap = dot(out, normal), step = 1 / (length(apart_) + no_length);
  for (int i = 0; i < most_tilts && step > smallest_tilt; ++i) {
    const V3 tilt = step * (out - gap * normal);
    if (length(tilt) < smallest_tilt) break;
    const V3 next = unit(normal + tilt);
    const V3 there = apart_ - support(next).at;
    if (dot(there, next) > gap) {
      normal = next, out = there, gap = dot(there, next);
      step *= 1.5;
    } else {
      step /= 2;
    }
  }
  return gap;
}

}  // namespace pulvis::space
