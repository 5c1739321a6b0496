// How strong a bond is: in two and in three dimensions alike.
#pragma once

#include <algorithm>

#include "components/bond.hpp"
#include "systems/laws/bond.hpp"

namespace pulvis {

// The law of one bonded point. Weaker bonds open as far as strong ones before they break.
inline kernels::CohesiveLaw cohesive_law(const BondRules::Law& law, double k, double strength) {
  return {k,
          k,
          law.strength * strength,
          law.shear_strength * strength,
          law.energy * strength,
          law.shear_energy * strength,
          law.mixed_exponent};
}

// Of bonds made at the start between two neighbours, relative to the law's (Weibull 1951): P(share < s) = 1 - exp(-s^m).
// Seeded by the two numbers, so that both sides draw the same. A tool's number is -1 - its position.
double drawn_strength(const BondRules::Law& law, int first, int second);

// Surfaces weld once their pressure has dropped to this share of its maximum: while it grows they are in contact, and
// slide with friction.
inline constexpr double weld_at = 0.5;

// Of a weld, relative to the law's. `largest`: Pa, contact pressure so far; above the threshold.
inline double welded_strength(const BondRules::Law& law, double largest) {
  return std::min(1.0, law.growth * (largest - law.threshold) / law.strength);
}

}  // namespace pulvis
