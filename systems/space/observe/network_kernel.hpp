// Properties of a contact network in three dimensions as a whole.
//
// Source   fabric tensor: Satake, "Fabric tensor in granular materials" (1982); Oda, Soils & Foundations 22(4), 96 (1982)
// Law      F_ij = mean over the contacts of n_i n_j: trace 1; anisotropy = sqrt(3/2 F' : F') with F' its deviator, 0 if
//          isotropic, 1 if all contacts are parallel
#pragma once

#include <cmath>
#include <span>

#include "components/observed.hpp"

namespace pulvis::space::kernels {

struct Fabric {
  double xx = 0, yy = 0, zz = 0, xy = 0, yz = 0, zx = 0;
  double anisotropy() const {
    const double mean = (xx + yy + zz) / 3, x = xx - mean, y = yy - mean, z = zz - mean;
    return std::sqrt(1.5 * (x * x + y * y + z * z + 2 * (xy * xy + yz * yz + zx * zx)));
  }
};

inline Fabric fabric(std::span<const ContactLink<ThreeD>> links) {
  Fabric f;
  for (const ContactLink<ThreeD>& link : links) {
    const auto [x, y, z] = link.normal;
    const double share = 1 / static_cast<double>(links.size());
    f.xx += share * x * x;
    f.yy += share * y * y;
    f.zz += share * z * z;
    f.xy += share * x * y;
    f.yz += share * y * z;
    f.zx += share * z * x;
  }
  return f;
}

}  // namespace pulvis::space::kernels
