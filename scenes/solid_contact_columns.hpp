// Contact data in three dimensions: tables, columns, rules and the shapes of tools.
#pragma once

#include "engine/world.hpp"
#include "scenes/needs.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis::space {

// Does nothing if nothing can touch. The world must have Bodies, Shapes, its particles and nodes, and its tool columns.
void add_contact(World& world, const Scene& scene, const Needs& needs);

}  // namespace pulvis::space
