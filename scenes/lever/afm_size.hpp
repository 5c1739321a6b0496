// How large the solid of an AFM scene will be: estimated from its keys, before anything is meshed.
#pragma once

#include <cstdint>

#include "scenes/spec/scene.hpp"

namespace pulvis {

struct SolidSize {
  double elements = 0, nodes = 0;
  double matrix = 0;   // entries of the stiffness matrix
  double factors = 0;  // entries of its factors
  double answers = 0;  // entries of its responses to forces on the contact points
  double bytes() const;
};
SolidSize lever_size(const AfmScene& afm);
SolidSize tip_size(const AfmScene& afm);
SolidSize afm_size(const AfmScene& afm);

// Upper limits for meshing. The entries of the factors are counted in 32 bits.
inline constexpr double max_solid_elements = 250'000;
inline constexpr double max_solid_factors = 1.8e9;  // 22 GB
inline bool is_too_large(const SolidSize& size) {
  return size.elements > max_solid_elements || size.factors > max_solid_factors;
}

// Throws OutputError where this machine does not have enough free memory.
void require_afm_memory(const Scene& scene);

}  // namespace pulvis
