// From a scene's stages to what moves its tools: programmes, servos, and what ends a stage early.
#pragma once

#include "engine/world.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// Needs the columns of the tools, and ToolPosition filled.
void add_drives(World& world, const Scene& scene, const std::vector<BodySpec>& bodies);

}  // namespace pulvis
