// Overall measures of a contact network: coordination, fabric, forces, orientation.
//
// Source   fabric tensor: Satake, "Fabric tensor in granular materials" (1982); Oda, Soils & Foundations
//          22(4), 96 (1982)
// Law      F_ij = mean over the contacts of n_i n_j: trace 1; anisotropy = difference of its principal
//          values, 0 if the directions are isotropic, 1 if all contacts are parallel
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "components/observed.hpp"
#include "engine/entry.hpp"
#include "engine/portable_math.hpp"

namespace pulvis::kernels {

struct Fabric {
  double xx = 0, xy = 0, yy = 0;
  double anisotropy() const { return 2 * portable::hypot(0.5 * (xx - yy), xy); }
  // rad, in (-pi/2, pi/2]: the preferred direction of the contact normals.
  double angle() const { return 0.5 * portable::atan2(2 * xy, xx - yy); }
};

inline Fabric fabric(std::span<const ContactLink<TwoD>> links) {
  Fabric f;
  const double share = 1 / static_cast<double>(std::max<std::size_t>(1, links.size()));
  for (const ContactLink<TwoD>& link : links) {
    f.xx += share * link.normal[0] * link.normal[0];
    f.xy += share * link.normal[0] * link.normal[1];
    f.yy += share * link.normal[1] * link.normal[1];
  }
  return f;
}

struct ForceSizes {
  double mean = 0, maximum = 0;  // N, normal
};

template <class Links>
ForceSizes force_sizes(const Links& links) {
  ForceSizes sizes;
  for (const auto& link : links) {
    sizes.mean += link.normal_force() / static_cast<double>(links.size());
    sizes.maximum = std::max(sizes.maximum, link.normal_force());
  }
  return sizes;
}

// Per particle: how many other particles, or tools, it touches.
template <class Links>
void count_contacts(const Links& links, bool both, std::vector<double>& counts) {
  for (const auto& link : links) {
    entry(counts, link.first) += 1;
    if (both) entry(counts, link.second) += 1;
  }
}

// Directions of contact normals, from 0 to 180 degrees since a contact faces both ways. Sector k is at
// k times 180/18 degrees, so that the axes are sector centres.
inline constexpr int rose_sectors = 18;

// By force: its size, in tension too.
struct Rose {
  std::array<double, rose_sectors> number{}, force{};  // shares of all contacts; each sums to 1
};

inline Rose rose(std::span<const ContactLink<TwoD>> links) {
  Rose rose;
  double all = 0;
  for (const ContactLink<TwoD>& link : links) all += std::abs(link.normal_force());
  for (const ContactLink<TwoD>& link : links) {
    const double turn = portable::atan2(link.normal[1], link.normal[0]) / std::numbers::pi;
    const auto nearest = static_cast<int>(std::lround(rose_sectors * turn));
    const auto sector = static_cast<std::size_t>((nearest + rose_sectors) % rose_sectors);
    rose.number[sector] += 1 / static_cast<double>(links.size());
    if (all > 0) rose.force[sector] += std::abs(link.normal_force()) / all;
  }
  return rose;
}

}  // namespace pulvis::kernels
