// What a scene in three dimensions requests under [output] beyond forces and energies: its columns and resources.
#pragma once

#include "engine/world.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis::space {

// Whether the tools enclose a room along whose axes a grid can be aligned.
bool has_grid_room(const Scene& scene);

// Adds what the scene requests to a world that has its particles and contacts.
void add_observed(World& world, const Scene& scene);

}  // namespace pulvis::space
