// Splits a hexahedron into eight parts by halving it along its three natural directions.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>

namespace pulvis {

// each(volume, low, high) for the eight parts of a hexahedron: volume, m^3, from the Jacobian at its centre (trilinear shape
// functions, Hughes 1987, ch. 3), and its range of z. Corners in VTK order.
template <class Each>
void for_parts(std::span<const double> xyz, std::span<const std::int32_t> corners, Each each) {
  using Vec3 = Eigen::Vector3d;
  // x = sum of modes times 1, xi, eta, xi eta, zeta, zeta xi, eta zeta, xi eta zeta: bits of the index select the factors.
  std::array<Vec3, 8> mode;
  static constexpr std::array<std::size_t, 8> vtk{0, 1, 3, 2, 4, 5, 7, 6};  // in bit order, too
  for (std::size_t n = 0; n < 8; ++n)
    mode[n] = Vec3::Map(&xyz[3 * static_cast<std::size_t>(corners[vtk[n]])]) / 8;
  for (const std::size_t bit : {1U, 2U, 4U})
    for (std::size_t n = 0; n < 8; ++n)
      if ((n & bit) == 0) {
        const Vec3 low = mode[n], high = mode[n | bit];
        mode[n] = high + low;
        mode[n | bit] = high - low;
      }
  for (int part = 0; part < 8; ++part) {
    const double xi = part & 1 ? 0.5 : -0.5, eta = part & 2 ? 0.5 : -0.5,
                 zeta = part & 4 ? 0.5 : -0.5;
    // Each tangent vector is as long as the part.
    const Vec3 x = mode[1] + eta * mode[3] + zeta * (mode[5] + eta * mode[7]),
               y = mode[2] + xi * mode[3] + zeta * (mode[6] + xi * mode[7]),
               z = mode[4] + xi * mode[5] + eta * (mode[6] + xi * mode[7]);
    const double middle =
        mode[0].z() + xi * x.z() + eta * (mode[2].z() + zeta * mode[6].z()) + zeta * mode[4].z();
    const double half = (std::abs(x.z()) + std::abs(y.z()) + std::abs(z.z())) / 2;
    each(x.cross(y).dot(z), middle - half, middle + half);
  }
}

}  // namespace pulvis
