// How fast a powder deforms as a whole in the next step, by strains or by stresses.
//
// A strain is spread over its stage with smooth ramps (systems/tools/tool_kernel.hpp). A stress is kept by a servo: the part
// of the rate of deformation moves as a mass that the missing stress pushes and a dashpot damps
// (systems/tools/servo_kernel.hpp), with the force (asked - stress) area thickness, the mass in kg m^2, the speed in 1/s. What
// is asked for may follow from another part of the stress as it is now: a ratio to yy, or a mean with it.
#pragma once

#include <array>

#include "components/cell.hpp"
#include "components/run_state.hpp"
#include "systems/tools/servo_kernel.hpp"

namespace pulvis {

struct Rates {
  std::array<double, MixedControl::parts> deformation{};  // 1/s
  double spin = 0;                                        // rad/s
};

// `volume`: m^3, of the powder with its pores. `touching`: what resists each part, in N m and N m s. Throws RunFailure
// where a stage has just ended and a stress was not held.
Rates rates_of(MixedControl& control, const ToolProgram& program, const Clock& clock, double volume,
               const std::array<kernels::TouchSums, MixedControl::parts>& touching);

// What has come of them after a step.
void add_strain(MixedControl& control, const Rates& rates, double dt);

}  // namespace pulvis
