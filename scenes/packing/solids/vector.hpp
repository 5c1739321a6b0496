// Vectors and rotations for packings: plain arithmetic in a fixed order, identical on every machine (reasons in
// scenes/outlines/portable.hpp). Rotations need no sine here.
#pragma once

#include <cmath>

namespace pulvis::space {

struct V3 {
  double x = 0, y = 0, z = 0;
  bool operator==(const V3&) const = default;
};
inline V3 operator+(const V3& a, const V3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline V3 operator-(const V3& a, const V3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline V3 operator-(const V3& a) { return {-a.x, -a.y, -a.z}; }
inline V3 operator*(double k, const V3& a) { return {k * a.x, k * a.y, k * a.z}; }
inline double dot(const V3& a, const V3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline V3 cross(const V3& a, const V3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(const V3& a) { return std::sqrt(dot(a, a)); }
inline V3 unit(const V3& a) { return (1 / length(a)) * a; }

// A rotation as a unit quaternion.
struct Turn {
  double w = 1, x = 0, y = 0, z = 0;
};
inline Turn operator*(const Turn& p, const Turn& q) {
  return {
      p.w * q.w - p.x * q.x - p.y * q.y - p.z * q.z, p.w * q.x + p.x * q.w + p.y * q.z - p.z * q.y,
      p.w * q.y - p.x * q.z + p.y * q.w + p.z * q.x, p.w * q.z + p.x * q.y - p.y * q.x + p.z * q.w};
}
inline Turn reversed(const Turn& q) { return {q.w, -q.x, -q.y, -q.z}; }
inline V3 operator*(const Turn& q, const V3& a) {
  const V3 u{q.x, q.y, q.z};
  const V3 twice = 2 * cross(u, a);
  return a + q.w * twice + cross(u, twice);
}
inline V3 turned_back(const Turn& q, const V3& a) { return reversed(q) * a; }
// Rotated further, about the direction of `half` by twice the arc tangent of its length (Cayley map): about twice the length
// if that is small.
inline Turn turned(const Turn& q, const V3& half) {
  const Turn r = Turn{1, half.x, half.y, half.z} * q;
  const double norm = 1 / std::sqrt(r.w * r.w + r.x * r.x + r.y * r.y + r.z * r.z);
  return {norm * r.w, norm * r.x, norm * r.y, norm * r.z};
}

}  // namespace pulvis::space
