// Vectors as used in scenes.
#pragma once

#include <Eigen/Core>

namespace pulvis {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;  // z = 0 in two dimensions

inline Vec2 in_plane(const Vec3& v) { return v.head<2>(); }
inline Vec3 in_space(const Vec2& v) { return {v.x(), v.y(), 0}; }

// The out-of-plane component of a × b.
inline double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

}  // namespace pulvis
