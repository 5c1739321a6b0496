// The step in three dimensions: the one ordered list of its systems.
#pragma once

#include <vector>

#include "engine/system.hpp"
#include "engine/world.hpp"

namespace pulvis::space {

// As StepList (systems/step.hpp).
struct Steps {
  std::vector<System> forces, observe, motion;
};
Steps steps_of(World& world);

// Of sampled steps, of the powder as a whole.
std::vector<System> observers_of_whole(World& world);

// What has to be known before the first step.
std::vector<System> start_of(World& world);

}  // namespace pulvis::space
