// Which root of the wedge calibration do the friction loops agree with, all together?
//
// Source   every loop on its slope gives mu and, without adhesion, 1/mu (wedge_calibration.hpp), but the sensitivities
//          that belong to the two differ in another way on every slope, on a flat facet, and in what adhesion adds
//          at zero load. One mu, one sensitivity and, as far as the loops have them, one adhesion, crosstalk and
//          offset of the detector are fitted to all half-widths and offsets at once, below the double root and above
//          it; slopes may move by their standard uncertainty. Ratio of the likelihoods of the two fits: with
//          known errors the sums of squares differ by more than 9, three standard deviations (scaled up where not
//          even the better one fits, Birge 1932); with unknown ones, the same probability by Student's
//          distribution, with the scatter about the better fit
#pragma once

#include <optional>
#include <vector>

#include "scenes/wedge/wedge_calibration.hpp"

namespace pulvis::wedge {

// Empty where the loops do not decide. `lower` and `upper`: their evaluations with either root.
std::optional<Root> agreeing_root(const std::vector<Loop>& loops, const Known& known,
                                  const Calibration& lower, const Calibration& upper);

}  // namespace pulvis::wedge
