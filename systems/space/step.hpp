// The time step in three dimensions: the ordered list of its systems.
#pragma once

#include <vector>

#include "engine/system.hpp"
#include "engine/world.hpp"

namespace pulvis::space {

// Same as StepList (systems/step.hpp).
struct Steps {
  std::vector<System> forces, observe, motion;
};
Steps steps_of(World& world);

// Systems of sampled steps that observe the powder as a whole.
std::vector<System> observers_of_whole(World& world);

// Systems that run once before the first step.
std::vector<System> start_of(World& world);

}  // namespace pulvis::space
