#include "scenes/outlines/outline_reach.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

#include "scenes/outlines/outline.hpp"
#include "scenes/spec/rotation.hpp"

namespace pulvis {
namespace {

constexpr double fine = 1e-6;  // deviation of the polygon, of a particle's size

}  // namespace

double reach_along(const Outline& outline, double angle, const Vec2& direction) {
  const Vec2 own = rotation(-angle) * direction;
  if (const auto box = rounded_box(outline)) return box->radius + own.cwiseAbs().dot(box->half);
  double farthest = std::numeric_limits<double>::lowest();
  for (const Vec2& p : outline_polygon(outline, fine * std::sqrt(outline_area(outline))))
    farthest = std::max(farthest, own.dot(p));
  return farthest;
}

}  // namespace pulvis
