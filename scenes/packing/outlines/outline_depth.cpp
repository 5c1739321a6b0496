#include "scenes/packing/outlines/outline_depth.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "engine/portable_math.hpp"
#include "scenes/spec/rotation.hpp"

namespace pulvis {
namespace {

double length_of(const Outline& outline) { return std::sqrt(outline_area(outline)); }

// Half sizes of a box, and its corners and axes in scene coordinates.
struct TurnedBox {
  Vec2 half, centre;
  Eigen::Matrix2d turn;
  TurnedBox(const BodySpec& body, const RoundedBox& box)
      : half(box.half), centre(in_plane(body.position)), turn(rotation(body.angle)) {}
  std::array<Vec2, 4> corners() const {
    std::array<Vec2, 4> list;
    for (std::size_t i = 0; i < 4; ++i)
      list[i] =
          centre + turn * Vec2(i % 2 == 0 ? -half.x() : half.x(), i < 2 ? -half.y() : half.y());
    return list;
  }
  // Distance of a point from the box; inside, the distance to its nearest side, negative.
  double distance(const Vec2& point) const {
    const Vec2 beyond = (turn.transpose() * (point - centre)).cwiseAbs() - half;
    return beyond.maxCoeff() <= 0 ? beyond.maxCoeff() : beyond.cwiseMax(0).norm();
  }
  // Largest gap between this box and points along one of its axes; negative if they overlap.
  double gap(const std::array<Vec2, 4>& points) const {
    Vec2 low = Vec2::Constant(std::numeric_limits<double>::max()), high = -low;
    for (const Vec2& point : points) {
      const Vec2 p = turn.transpose() * (point - centre);
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    return (low - half).cwiseMax(-half - high).maxCoeff();
  }
};

// Distance of two boxes: apart, a corner of one is closest; overlapping, minus the separating translation
// (separating axes, Gottschalk 1996).
double box_distance(const TurnedBox& a, const TurnedBox& b) {
  const auto of_a = a.corners(), of_b = b.corners();
  const double gap = std::max(a.gap(of_b), b.gap(of_a));
  if (gap <= 0) return gap;
  double minimum = std::numeric_limits<double>::max();
  for (const Vec2& corner : of_a) minimum = std::min(minimum, b.distance(corner));
  for (const Vec2& corner : of_b) minimum = std::min(minimum, a.distance(corner));
  return minimum;
}

}  // namespace

std::vector<Vec2> check_polygon(const Outline& outline) {
  return outline_polygon(outline, check_deviation * length_of(outline));
}

OutlineDepths::OutlineDepths(const Scene& scene) {
  for (const ParticleSpec& particle : scene.particles) {
    boxes_.push_back(rounded_box(particle.outline));
    if (!boxes_.back()) unit_ = std::max(unit_, length_of(particle.outline));
  }
  if (unit_ == 0) return;
  for (const ParticleSpec& particle : scene.particles)
    shapes_.push_back(rigid_shape(particle.outline, unit_,
                                  check_deviation * length_of(particle.outline), Fit::inside));
}

RigidPose OutlineDepths::pose(const BodySpec& body) const {
  const portable::Turn turn{portable::cos(body.angle), portable::sin(body.angle)};
  const portable::V2 at{body.position.x() / unit_, body.position.y() / unit_};
  return {at + turn * shapes_[static_cast<std::size_t>(body.particle)].centroid, turn};
}

double OutlineDepths::between(const BodySpec& a, const BodySpec& b) {
  const auto i = static_cast<std::size_t>(a.particle), k = static_cast<std::size_t>(b.particle);
  if (boxes_[i] && boxes_[k])
    return boxes_[i]->radius + boxes_[k]->radius - box_distance({a, *boxes_[i]}, {b, *boxes_[k]});
  double depth = std::numeric_limits<double>::lowest();
  for (const RigidTouch& touch : contacts_.between(shapes_[i], pose(a), shapes_[k], pose(b), 0))
    depth = std::max(depth, -touch.gap * unit_);
  return depth;
}

}  // namespace pulvis
