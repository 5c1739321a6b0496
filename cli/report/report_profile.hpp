// Relative density of a powder in three dimensions along z: the solid volume of each slice divided by the slice's
// volume.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/files/hdf5.hpp"

namespace pulvis {

struct DensityProfile {
  std::vector<double> density;  // of the slices, from the bottom
  std::vector<double> edges;    // m, z, one more than slices
};

// Hexahedra: eight rows of `xyz` each. `area`: m^2, cross-section of the space. The slices are equally thick and reach
// from the lowest to the highest point.
DensityProfile density_along_z(std::span<const double> xyz, std::span<const std::int32_t> hexahedra,
                               double area, std::size_t slices);

struct CrossSection {
  double area = 0;    // m^2
  std::string bound;  // "die", "walls", "powder": whose inside it is
};
// For a frame: of the round die along z if there is one; else of the box formed by upright walls across x and y, which
// is as wide as the powder where there is no wall.
CrossSection cross_section(const hdf5::File& file, const std::string& frame,
                           std::span<const double> xyz);

}  // namespace pulvis
