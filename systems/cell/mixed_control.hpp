// Deformation rate of the whole powder in the next step, under strain or stress control.
//
// A strain is spread over its stage with smooth ramps (systems/tools/tool_kernel.hpp). A stress is held by a servo: that
// component of the rate moves as a mass driven by the missing stress and damped by a dashpot
// (systems/tools/servo_kernel.hpp), with the force (target - stress) volume, the mass in kg m^2, the speed in 1/s.
// The target may depend on the current axial stress (yy in the plane, zz in space): as a ratio to it, or so that the mean of the
// normal stresses is kept while the lateral ones are equal.
#pragma once

#include <array>

#include "components/cell.hpp"
#include "components/run_state.hpp"
#include "systems/tools/servo_kernel.hpp"

namespace pulvis {

struct Rates {
  std::array<double, MixedControl::parts> deformation{};  // 1/s
  Point3 spin{};                                          // rad/s
};

// `volume`: m^3, of the powder including its pores. `touching`: resistance to each component, in N m and N m s. Throws
// RunFailure where a stage has just ended and a stress was not reached.
Rates rates_of(MixedControl& control, const ToolProgram& program, const Clock& clock, double volume,
               const std::array<kernels::TouchSums, MixedControl::parts>& touching);

// Adds the strain of a step.
void add_strain(MixedControl& control, const Rates& rates, double dt);

}  // namespace pulvis
