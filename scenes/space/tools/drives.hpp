// Columns and tool motion from a scene's tools and stages: programme, servos, and conditions that end a stage early.
#pragma once

#include "engine/world.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis::space {

// The world must have its bodies with their shapes.
void add_tools(World& world, const Scene& scene, const std::vector<BodySpec>& bodies);

}  // namespace pulvis::space
