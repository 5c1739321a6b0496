// Relative density of a powder in three dimensions along z: the solid volume of each slice divided by the slice's
// volume.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/files/hdf5.hpp"

namespace pulvis {

struct DensityProfile {
  std::vector<double> density;  // of the slices, from the bottom
  std::vector<double> edges;    // m, z, one more than slices
};

struct CrossSection {
  double area = 0;  // m^2
  // Whose inside it is: "die", "die with a mouth", "walls", "powder"; "die across z" has no area.
  std::string bound;
  // m, z of level planes below and above the powder, in a die also of punches.
  std::optional<double> bottom = {}, top = {};
  // m, the part of z in which the space has this cross-section: a die ends at its mouth.
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
};

// Hexahedra: eight rows of `xyz` each. The slices are equally thick and reach from the bottom to the top, or to the lowest
// and the highest point where there is no plane, within the ends of the section; there are none if nothing is between these.
DensityProfile density_along_z(std::span<const double> xyz, std::span<const std::int32_t> hexahedra,
                               const CrossSection& section, std::size_t slices);

// For a frame: of the round die along z if there is one; else of the box formed by upright walls across x and y, which
// is as wide as the powder where there is no wall. A die that does not stand along z has none.
CrossSection cross_section(const hdf5::File& file, const std::string& frame,
                           std::span<const double> xyz);

}  // namespace pulvis
