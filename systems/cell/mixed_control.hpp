// Deformation rate of the whole powder in the next step, under strain or stress control.
//
// A strain is spread over its stage with smooth ramps (systems/tools/tool_kernel.hpp). A stress is held by a servo: that
// component of the rate moves as a mass driven by the missing stress and damped by a dashpot
// (systems/tools/servo_kernel.hpp), with the force (target - stress) area thickness, the mass in kg m^2, the speed in 1/s.
// The target may depend on another current stress component: as a ratio to yy, or as a mean with it.
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

// `volume`: m^3, of the powder including its pores. `touching`: resistance to each component, in N m and N m s. Throws
// RunFailure where a stage has just ended and a stress was not reached.
Rates rates_of(MixedControl& control, const ToolProgram& program, const Clock& clock, double volume,
               const std::array<kernels::TouchSums, MixedControl::parts>& touching);

// Adds the strain of a step.
void add_strain(MixedControl& control, const Rates& rates, double dt);

}  // namespace pulvis
