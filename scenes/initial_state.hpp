// Begins a run with the state that another one has kept.
#pragma once

#include "engine/world.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// Bodies, contacts, bonds, the cell and all sums are the state's; time and stages are the scene's and begin anew, at rest.
// Where the scene names a state.
void begin_with_state(World& world, const Scene& scene);

}  // namespace pulvis
