// Strength of a porous body: strength = strength_0 exp(-k porosity).
//
// Sources   Ryshkewitch (1953), Duckworth (1953)
// Linear least squares of ln(strength) against porosity; all points have equal weight.
#pragma once

#include <vector>

namespace pulvis {

struct PorosityFit {
  double dense_strength = 0;  // strength_0, in the unit of the strengths
  double k = 0;               // -
  double r_squared = 0;       // of ln(strength); NaN if all strengths are equal
};

// Needs points with at least two different porosities, all strengths > 0.
PorosityFit fit_porosity(const std::vector<double>& porosity, const std::vector<double>& strength);

}  // namespace pulvis
