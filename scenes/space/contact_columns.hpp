// What contact asks for in three dimensions: tables, columns, rules and the shapes of tools.
#pragma once

#include "engine/world.hpp"
#include "scenes/spec/space_scene.hpp"

namespace pulvis::space {

// Nothing where nothing can touch. The world has Bodies, Shapes, its particles and nodes, and the columns of its tools.
void add_contact(World& world, const Scene& scene, const std::vector<BodySpec>& bodies);

}  // namespace pulvis::space
