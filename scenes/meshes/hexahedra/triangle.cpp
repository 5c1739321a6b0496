#include "scenes/meshes/hexahedra/triangle.hpp"

#include <algorithm>

namespace pulvis::space {
namespace {

Vec3 closest_on_side(const Vec3& from, const Vec3& to, const Vec3& p) {
  const Vec3 side = to - from;
  return from + std::clamp((p - from).dot(side) / side.squaredNorm(), 0.0, 1.0) * side;
}

}  // namespace

NearTriangle::NearTriangle(const Triangle& t) : corners_(t), normal_(area_vector(t)) {
  for (std::size_t k = 0; k < 3; ++k) inwards_[k] = normal_.cross(t[(k + 1) % 3] - t[k]);
}

Vec3 NearTriangle::closest(const Vec3& p) const {
  const Triangle& t = corners_;
  Vec3 best = t[0];
  bool outside = false;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 &from = t[k], &to = t[(k + 1) % 3];
    if (inwards_[k].dot(p - from) > 0) continue;
    const Vec3 near = closest_on_side(from, to, p);
    if (!outside || (near - p).squaredNorm() < (best - p).squaredNorm()) best = near;
    outside = true;
  }
  if (outside) return best;
  return p - (p - t[0]).dot(normal_) / normal_.squaredNorm() * normal_;
}

}  // namespace pulvis::space
