// Triangles in three dimensions.
#pragma once

#include <array>

#include "scenes/spec/scene.hpp"

namespace pulvis::space {

using Triangle = std::array<Vec3, 3>;

// Twice its area times its normal.
inline Vec3 area_vector(const Triangle& t) { return (t[1] - t[0]).cross(t[2] - t[0]); }

// With what its closest points need, for many of them. Ericson, Real-Time Collision Detection (2005), 5.1.5.
class NearTriangle {
 public:
  explicit NearTriangle(const Triangle& triangle);
  // On its outer side, or in its plane.
  bool is_before(const Vec3& p) const { return !(normal_.dot(p - corners_[0]) < 0); }
  Vec3 closest(const Vec3& to) const;

 private:
  Triangle corners_;
  Vec3 normal_;
  std::array<Vec3, 3> inwards_;  // from each side, in its plane
};

inline Vec3 closest_point(const Triangle& triangle, const Vec3& to) {
  return NearTriangle(triangle).closest(to);
}

}  // namespace pulvis::space
