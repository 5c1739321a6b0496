// Force curves of a programme: what pulls the probe back when it is drawn off the sample.
//
// A curve is a press (or several actions, with holds between) and all retracting actions that follow it,
// with holds between them. It counts once the tip is released. Pull-off is
// the greatest pull over them; its work is the area under the line of no force, F against the travel of the scanner, so
// that it holds what the lever stored, (pull-off)^2/(2 k_n) of a stiff contact, and is that of a measured curve
// (scenes/volts/force_curve.hpp). The work of adhesion follows from the pull-off by the law of the contact:
//   DMT  F = 2 pi w R,  sharp tips by their rounding        JKR  F = 3/2 pi w R
#pragma once

#include <optional>
#include <vector>

#include "scenes/lever/afm_loop.hpp"

namespace pulvis {

struct ForceCurveFigures {
  int action = 0;                          // the first retracting one
  bool released = false;                   // without contact at the end: else there is no pull-off
  double greatest = 0;                     // N, the largest force before
  double pull_off = 0;                     // N, >= 0
  double work = 0;                         // J
  std::optional<double> work_of_adhesion;  // J/m^2, where the tip has a radius
};

bool has_force_curve(const Scene& scene);

std::vector<ForceCurveFigures> force_curves(const Scene& scene, const AfmHistory& history);

}  // namespace pulvis
