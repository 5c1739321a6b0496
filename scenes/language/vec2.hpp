// A vector in the plane, as used in scenes.
#pragma once

#include <Eigen/Core>

namespace pulvis {

using Vec2 = Eigen::Vector2d;

// The out-of-plane component of a × b.
inline double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

}  // namespace pulvis
