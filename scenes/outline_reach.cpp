#include "scenes/outline_reach.hpp"

#include <Eigen/Geometry>

#include "scenes/outline.hpp"

namespace pulvis {

double reach_along(const Outline& outline, double angle, const Vec2& direction) {
  const RoundedBox box = rounded_box(outline);
  const Vec2 own = Eigen::Rotation2Dd(-angle) * direction;
  return box.radius + own.cwiseAbs().dot(box.half);
}

}  // namespace pulvis
