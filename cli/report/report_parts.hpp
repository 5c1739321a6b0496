// A hexahedron as the eight parts that halving it along its three natural directions makes.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <span>

namespace pulvis {

// each(volume, low, high) of every part: its volume, m^3, by the Jacobian at its middle (trilinear shape functions,
// Hughes 1987, ch. 3), and between which z it lies. Corners in the order of VTK.
template <class Each>
void for_parts(std::span<const double> xyz, std::span<const std::int32_t> corners, Each each) {
  using Vec3 = Eigen::Vector3d;
  const auto corner = [&](int i, int j, int k) {
    static constexpr int order[2][2] = {{0, 3}, {1, 2}};
    const auto node =
        static_cast<std::size_t>(corners[static_cast<std::size_t>(order[i][j] + 4 * k)]);
    return Vec3(Vec3::Map(&xyz[3 * node]));
  };
  // At (a, b, c) quarters from the corner (0, 0, 0).
  const auto at = [&](int a, int b, int c) {
    Vec3 point = Vec3::Zero();
    for (int n = 0; n < 8; ++n) {
      const int i = n & 1, j = n >> 1 & 1, k = n >> 2;
      point += (i ? a : 4 - a) * (j ? b : 4 - b) * (k ? c : 4 - c) / 64.0 * corner(i, j, k);
    }
    return point;
  };
  for (int part = 0; part < 8; ++part) {
    const int a = 1 + 2 * (part & 1), b = 1 + 2 * (part >> 1 & 1), c = 1 + 2 * (part >> 2);
    const Vec3 x = at(a + 1, b, c) - at(a - 1, b, c), y = at(a, b + 1, c) - at(a, b - 1, c),
               z = at(a, b, c + 1) - at(a, b, c - 1);
    const double half = (std::abs(x.z()) + std::abs(y.z()) + std::abs(z.z())) / 2;
    const double middle = at(a, b, c).z();
    each(x.cross(y).dot(z), middle - half, middle + half);
  }
}

}  // namespace pulvis
