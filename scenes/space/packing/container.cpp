#include "scenes/space/packing/container.hpp"

#include <algorithm>
#include <numbers>

namespace pulvis::space {
namespace {

constexpr int floor_wall = 0, punch = 1, round_wall = 2;
constexpr int starts = 16;  // around the axis, to find the particle's farthest point from it
constexpr int most_steps = 40;  // for each
constexpr double no_step = 1e-9;

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

}  // namespace

double Container::floor_area() const {
  return round() ? std::numbers::pi * radius * radius : width * depth;
}

int walls_of(const Container& container) { return container.round() ? 3 : 6; }

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

}  // namespace pulvis::space
