// Splits a hexahedron into tetrahedra between its centre and its faces; each face into four triangles around its own
// centre, which gives the volume of the trilinear element exactly, as local_density does.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "cli/report/report_space_mesh.hpp"

namespace pulvis {

struct Tetrahedron {
  double volume = 0;          // m^3, with sign
  std::array<double, 4> z{};  // m, of its corners, ascending

  // Share of the volume below a height: the integral of the area of its sections, which is a quadratic B-spline.
  double share_below(double height) const {
    const auto [a, b, c, d] = z;
    if (height <= a) return 0;
    if (height >= d) return 1;
    const double up = height - a, down = d - height;
    if (height <= b) return up / (b - a) * up / (c - a) * up / (d - a);
    if (height >= c) return 1 - down / (d - a) * down / (d - b) * down / (d - c);
    return (height - b) / (c - b) * (height - b) / (d - b) +
           up / (c - a) * (c - height) / (c - b) * (height - b) / (d - b) +
           up / (c - a) * up / (d - a) * down / (d - b);
  }
};

// each(Tetrahedron) for the 24 of a hexahedron. Corners in VTK order.
template <class Each>
void for_tetrahedra(std::span<const double> xyz, std::span<const std::int32_t> corners, Each each) {
  using Vec3 = Eigen::Vector3d;
  std::array<Vec3, 8> at;
  Vec3 centre = Vec3::Zero();
  for (std::size_t n = 0; n < 8; ++n) {
    at[n] = Vec3::Map(&xyz[3 * static_cast<std::size_t>(corners[n])]);
    centre += at[n] / 8;
  }
  for (const auto& side : sides_of_hexahedron) {
    const Vec3 middle = (at[side[0]] + at[side[1]] + at[side[2]] + at[side[3]]) / 4;
    for (std::size_t k = 0; k < 4; ++k) {
      const Vec3 &from = at[side[k]], &to = at[side[(k + 1) % 4]];
      Tetrahedron one{(from - centre).cross(to - centre).dot(middle - centre) / 6,
                      {centre.z(), middle.z(), from.z(), to.z()}};
      std::ranges::sort(one.z);
      each(one);
    }
  }
}

}  // namespace pulvis
