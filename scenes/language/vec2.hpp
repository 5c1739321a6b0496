// A vector of the plane, as scenes have it.
#pragma once

#include <Eigen/Core>

namespace pulvis {

using Vec2 = Eigen::Vector2d;

// The component of a × b out of the plane.
inline double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

}  // namespace pulvis
