// Triangles in three dimensions.
#pragma once

#include <array>

#include "scenes/spec/space_scene.hpp"

namespace pulvis::space {

using Triangle = std::array<Vec3, 3>;

// Twice its area times its normal.
inline Vec3 area_vector(const Triangle& t) { return (t[1] - t[0]).cross(t[2] - t[0]); }

// Ericson, Real-Time Collision Detection (2005), 5.1.5.
Vec3 closest_point(const Triangle& triangle, const Vec3& to);

}  // namespace pulvis::space
