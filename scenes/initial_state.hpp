// Starts a run from the saved state of another run.
#pragma once

#include "engine/world.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// Bodies, contacts, bonds, the cell and all sums come from the state; time and stages come from the scene and start
// anew, at rest. Cracks of the state have times <= 0. Does nothing unless the scene names a state.
void begin_with_state(World& world, const Scene& scene);

}  // namespace pulvis
