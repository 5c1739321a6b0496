#include "scenes/outlines/outline_reach.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

#include "scenes/spec/rotation.hpp"

namespace pulvis {
namespace {

constexpr double fine = 1e-6;  // deviation of the polygon, relative to the particle's size

}  // namespace

OutlineReach::OutlineReach(const Outline& outline) : box_(rounded_box(outline)) {
  if (!box_) polygon_ = outline_polygon(outline, fine * std::sqrt(outline_area(outline)));
}

double OutlineReach::along(double angle, const Vec2& direction) const {
  const Vec2 own = rotation(-angle) * direction;
  if (box_) return box_->radius + own.cwiseAbs().dot(box_->half);
  double farthest = std::numeric_limits<double>::lowest();
  for (const Vec2& p : polygon_) farthest = std::max(farthest, own.dot(p));
  return farthest;
}

}  // namespace pulvis
