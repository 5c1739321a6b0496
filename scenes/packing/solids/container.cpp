#include "scenes/packing/solids/container.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenes/packing/solids/near_pairs.hpp"

namespace pulvis::space {
namespace {

constexpr int floor_wall = 0, punch = 1, round_wall = 2;
constexpr int starts = 16;      // around the axis, to find the particle's farthest point from it
constexpr int most_steps = 40;  // for each
constexpr double no_step = 1e-9;
constexpr double max_turn = 0.25;  // half of the angle in one correction, rad

// Unit vectors at equal angles: (1, 0) rotated by 2 pi / 16 = 22.5 degrees.
constexpr double cos_of_step = 0.92387953251128674, sin_of_step = 0.38268343236508977;

struct Plane {
  V3 normal;      // into the powder
  double offset;  // normal . x on the plane
};

Plane plane_of(const Container& box, double height, int wall) {
  switch (wall) {
    case floor_wall:
      return {{0, 0, 1}, 0};
    case punch:
      return {{0, 0, -1}, -height};
    case 2:
      return {{1, 0, 0}, 0};
    case 3:
      return {{-1, 0, 0}, -box.width};
    case 4:
      return {{0, 1, 0}, 0};
    default:
      return {{0, -1, 0}, -box.depth};
  }
}

V3 farthest_along(const RigidShape& shape, const RigidPose& pose, const V3& n) {
  return pose.at + pose.turn * shape.support(turned_back(pose.turn, n));
}

struct Farthest {
  V3 at;
  double from_axis = -1;
};

// From a given direction, the support point's distance from the axis is increased to a maximum.
Farthest climb(const RigidShape& shape, const RigidPose& pose, V3 along) {
  Farthest best;
  for (int i = 0; i < most_steps; ++i) {
    const V3 p = farthest_along(shape, pose, along);
    const double distance = std::sqrt(p.x * p.x + p.y * p.y);
    if (distance <= best.from_axis + no_step) return best;
    best = {p, distance};
    along = {p.x / distance, p.y / distance, 0};
  }
  return best;
}

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
    const double off = container.periodic ? 0 : std::min(edge, size / 2);
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

double Container::floor() const {
  return round() ? std::numbers::pi * radius * radius : width * depth;
}

int walls_of(const Container& container) {
  if (container.periodic) return 0;
  return container.round() ? 3 : 6;
}

std::optional<RigidTouch> round_wall_touch(double radius, const RigidShape& shape,
                                           const RigidPose& pose, double range) {
  const double centre = std::sqrt(pose.at.x * pose.at.x + pose.at.y * pose.at.y);
  if (centre + shape.reach <= radius - range) return std::nullopt;
  V3 along = centre > 0 ? V3{pose.at.x / centre, pose.at.y / centre, 0} : V3{1, 0, 0};
  Farthest best;
  for (int i = 0; i < (shape.is_ball() ? 1 : starts); ++i) {
    const Farthest found = climb(shape, pose, along);
    if (found.from_axis > best.from_axis) best = found;
    along = {cos_of_step * along.x - sin_of_step * along.y,
             sin_of_step * along.x + cos_of_step * along.y, 0};
  }
  const double gap = radius - best.from_axis;
  if (gap >= range || best.from_axis <= 0) return std::nullopt;
  const double share = -1 / best.from_axis;
  return RigidTouch{best.at, {share * best.at.x, share * best.at.y, 0}, gap};
}

std::optional<RigidTouch> wall_touch(const Container& container, double height, int wall,
                                     const RigidShape& shape, const RigidPose& pose, double range) {
  if (container.round() && wall == round_wall)
    return round_wall_touch(container.radius, shape, pose, range);
  const Plane plane = plane_of(container, height, wall);
  if (dot(plane.normal, pose.at) - plane.offset - shape.reach >= range) return std::nullopt;
  const V3 deepest = farthest_along(shape, pose, -plane.normal);
  const double gap = dot(plane.normal, deepest) - plane.offset;
  return gap < range ? std::optional(RigidTouch{deepest, plane.normal, gap}) : std::nullopt;
}

namespace {

using Periods = std::array<std::int32_t, 3>;

// The particles moved into the cell, followed by their images that come near it.
struct PeriodicBalls {
  std::vector<Ball> balls;
  std::vector<std::int32_t> particle;  // [balls]
  std::vector<Periods> periods;        // [balls], from where the particle is
};

PeriodicBalls periodic_balls(const Container& cell, double height,
                             const std::vector<RigidPose>& poses, const std::vector<double>& radii,
                             double range) {
  const std::array<double, 3> size{cell.width, cell.depth, height};
  const double reach = 2 * std::ranges::max(radii) + range;  // of what can touch
  PeriodicBalls all;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const V3& at = poses[i].at;
    const Periods home{-static_cast<std::int32_t>(std::floor(at.x / size[0])),
                       -static_cast<std::int32_t>(std::floor(at.y / size[1])),
                       -static_cast<std::int32_t>(std::floor(at.z / size[2]))};
    all.balls.push_back({at + shift_of(cell, height, home), radii[i]});
    all.particle.push_back(static_cast<std::int32_t>(i));
    all.periods.push_back(home);
  }
  Periods most;
  for (std::size_t k = 0; k < 3; ++k) most[k] = static_cast<std::int32_t>(reach / size[k]) + 1;
  const auto is_near = [&](double at, double extent) { return at > -reach && at < extent + reach; };
  for (std::int32_t x = -most[0]; x <= most[0]; ++x)
    for (std::int32_t y = -most[1]; y <= most[1]; ++y)
      for (std::int32_t z = -most[2]; z <= most[2]; ++z) {
        if (x == 0 && y == 0 && z == 0) continue;
        const V3 shift = shift_of(cell, height, {x, y, z});
        for (std::size_t i = 0; i < poses.size(); ++i) {
          const V3 at = all.balls[i].centre + shift;
          if (!is_near(at.x, size[0]) || !is_near(at.y, size[1]) || !is_near(at.z, size[2]))
            continue;
          const Periods home = all.periods[i];
          all.balls.push_back({at, radii[i]});
          all.particle.push_back(static_cast<std::int32_t>(i));
          all.periods.push_back({home[0] + x, home[1] + y, home[2] + z});
        }
      }
  return all;
}

// Every pair once: from its first particle, or for one with its own image from either side.
std::vector<NearPair> periodic_pairs(const Container& cell, double height,
                                     const std::vector<RigidPose>& poses,
                                     const std::vector<double>& radii, double range) {
  const PeriodicBalls all = periodic_balls(cell, height, poses, radii, range);
  const auto count = static_cast<std::int32_t>(poses.size());
  std::vector<NearPair> pairs;
  for (const auto& [first, second] : near_pairs(all.balls, range)) {
    if (first >= count) continue;  // two images
    const auto i = static_cast<std::size_t>(first), k = static_cast<std::size_t>(second);
    const std::int32_t other = all.particle[k];
    Periods apart;
    for (std::size_t axis = 0; axis < 3; ++axis)
      apart[axis] = all.periods[k][axis] - all.periods[i][axis];
    if (other > first || (other == first && apart > Periods{}))
      pairs.push_back({first, other, apart});
  }
  return pairs;
}

}  // namespace

std::vector<NearPair> near_pairs(const Container& container, double height,
                                 const std::vector<RigidPose>& poses,
                                 const std::vector<double>& radii, double range) {
  if (container.periodic) return periodic_pairs(container, height, poses, radii, range);
  std::vector<Ball> balls;
  for (std::size_t i = 0; i < poses.size(); ++i) balls.push_back({poses[i].at, radii[i]});
  std::vector<NearPair> pairs;
  for (const auto& [a, b] : near_pairs(balls, range)) pairs.push_back({a, b});
  return pairs;
}

RigidPose random_pose(const Container& container, double height, const RigidShape& shape,
                      portable::Random& random) {
  const V3 at = random_place(container, height, shape.diameter / 2, random);
  return {at, random_turn(random)};
}

RigidPose shaken(const RigidPose& pose, const RigidShape& shape, double displacement,
                 portable::Random& random) {
  const V3 at = pose.at + shape.diameter * random_vector(random, displacement);
  const V3 turn = random_vector(random, displacement);
  return {at, shape.is_ball() ? pose.turn : turned(pose.turn, turn)};
}

RigidPose carried_on(const RigidPose& pose, const RigidPose& before, const RigidShape& shape,
                     double share) {
  const V3 at = pose.at + share * (pose.at - before.at);
  if (shape.is_ball()) return {at, pose.turn};
  const Turn change = pose.turn * reversed(before.turn);
  return {at, turned(pose.turn, share * V3{change.x, change.y, change.z})};
}

RigidPose corrected(const RigidPose& pose, const RigidShape& shape, const V3& arm,
                    const V3& correction) {
  const V3 at = pose.at + (1 / shape.content) * correction;
  if (shape.is_ball()) return {at, pose.turn};
  const V3 half = (1 / (2 * shape.content * shape.gyration)) * cross(arm, correction);
  const double size = length(half);
  if (!(size > 0)) return {at, pose.turn};
  return {at, turned(pose.turn, std::min(1.0, max_turn / size) * half)};
}

double leverage(const RigidShape& shape, const V3& arm, const V3& normal) {
  if (shape.is_ball()) return 0;
  const V3 turn = cross(arm, normal);
  return dot(turn, turn) / shape.gyration;
}

}  // namespace pulvis::space
