// Relative density of a powder in three dimensions along z: the solid volume of each of several slices over the slice's
// room.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/files/hdf5.hpp"

namespace pulvis {

struct DensityProfile {
  std::vector<double> density;  // of the slices, from below
  std::vector<double> edges;    // m, z, one more
};

// Hexahedra: eight rows of `xyz` each. `area`: m^2, of the room's cross-section. The slices, equally thick, reach from
// the lowest to the highest point.
DensityProfile density_along_z(std::span<const double> xyz, std::span<const std::int32_t> hexahedra,
                               double area, std::size_t slices);

struct CrossSection {
  double area = 0;    // m^2
  std::string bound;  // "die", "walls", "powder": what it is the inside of
};
// Of a frame: of the round die if there is one along z; else of the box that upright walls across x and y make, as wide
// as the powder where there is no wall.
CrossSection cross_section(const hdf5::File& file, const std::string& frame,
                           std::span<const double> xyz);

}  // namespace pulvis
