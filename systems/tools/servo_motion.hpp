// How fast tools that hold a force, or follow behind a spring, move in the next step. What touches them is found by the
// systems of each dimension.
#pragma once

#include <functional>

#include "systems/tools/servo_kernel.hpp"
#include "systems/tools/systems.hpp"

namespace pulvis {

// Springs and dashpots of what presses on a tool now.
using Touching = std::function<kernels::TouchSums(int tool)>;

void drive_tools(const Servos& servos, const Touching& touching);

}  // namespace pulvis
