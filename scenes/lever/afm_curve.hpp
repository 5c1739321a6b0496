// Force curves of a programme: the adhesion measured while the probe is retracted from the sample.
//
// A curve is a press (or several actions, with holds between) and all retracting actions that follow it,
// with holds between them. It counts once the tip is released. Pull-off is
// the largest tensile force; its work is the area below zero force of F against the scanner's travel. It therefore
// includes the energy stored in the lever, (pull-off)^2/(2 k_n) for a stiff contact, and equals that of a measured
// curve (cli/laboratory/volts/force_curve.hpp). The work of adhesion follows from the pull-off by the contact law:
// Both include the subdivisions of an increment, which locate the release to 0.05% of the pull-off force.
//   DMT  F = 2 pi w R,  sharp tips by their rounding        JKR  F = 3/2 pi w R
#pragma once

#include <optional>
#include <vector>

#include "scenes/lever/afm_loop.hpp"

namespace pulvis {

struct ForceCurveFigures {
  int action = 0;                          // the first retracting action
  bool released = false;                   // no contact at the end: otherwise there is no pull-off
  double greatest = 0;                     // N, largest force before retracting
  double pull_off = 0;                     // N, >= 0
  double work = 0;                         // J
  std::optional<double> work_of_adhesion;  // J/m^2, where the tip has a radius
};

// J, the area below zero under a straight line from one force to the next.
double pulling_area(double from, double to, double way);

bool has_force_curve(const Scene& scene);

std::vector<ForceCurveFigures> force_curves(const Scene& scene, const AfmHistory& history);

}  // namespace pulvis
