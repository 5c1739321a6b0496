// Converts a scene's stages to tool motion: programmes, servos, and what ends a stage early.
#pragma once

#include "engine/world.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// Requires the columns of the tools, with ToolPosition filled.
void add_drives(World& world, const Scene& scene, const std::vector<BodySpec>& bodies);

}  // namespace pulvis
