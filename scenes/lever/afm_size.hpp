// How large the solid of an AFM scene will be: known from its keys, before anything is meshed.
#pragma once

#include <cstdint>

#include "scenes/spec/scene.hpp"

namespace pulvis {

struct SolidSize {
  double elements = 0, nodes = 0;
  double matrix = 0;   // numbers of the stiffness
  double factors = 0;  // numbers of its factors
  double answers = 0;  // numbers of its answers to forces on the points that touch
  double bytes() const;
};
SolidSize lever_size(const AfmScene& afm);
SolidSize tip_size(const AfmScene& afm);
SolidSize afm_size(const AfmScene& afm);

// What is meshed at most. The factors' numbers are counted by 32 bits.
inline constexpr double max_solid_elements = 250'000;
inline constexpr double max_solid_factors = 1.8e9;  // 22 GB
inline bool is_too_large(const SolidSize& size) {
  return size.elements > max_solid_elements || size.factors > max_solid_factors;
}

// Throws OutputError where this machine has not got the memory now.
void require_afm_memory(const Scene& scene);

}  // namespace pulvis
