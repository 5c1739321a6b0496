// Stages that are too short for the force, or the stress, to be held at their end.
//
// A servo limits its speed to what the inertia of the powder allows (systems/tools/servo_kernel.hpp). Known before the first step:
//
// Gaps      sections across the direction of the force with nothing in them close before anything bears it, at the speed
//           2 F/Z of a servo without resistance, or max_speed. Between nodes of the meshes: those of coarse ones stand
//           out of the true surface, and less is counted
// Approach  counted in passages m_p/Z of an elastic wave through a solid block of the powder. How many it takes depends on
//           the stiffness of the powder, which is not known: `usual_passages` was measured
//
// Measured  tests/random_servo_powders.py --seed 1, 68 dies in two and three dimensions: of the 32 that this warns of, 31 did not
//           reach their force, of the other 36 ten (plastic powders under large forces, soft contacts under small ones). Of 34
//           periodic cells it warns of eight; seven stopped or passed their stress, and so did 21 of the others
#pragma once

#include <string>
#include <vector>

#include "engine/world.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// One line for each such servo, in two and three dimensions, and for each stress-controlled stage of a cell or a die. `world`: in
// its initial state.
std::vector<std::string> servo_warnings(const Scene& scene, const World& world);

}  // namespace pulvis
