// Tools as columns, and their motion from a scene's stages: programmes, servos, and what ends a stage early.
#pragma once

#include "components/dimension.hpp"
#include "engine/world.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// With normals, which constraints do not have.
void add_tool_columns(World& world, const Scene& scene, bool with_normals);

// Requires those columns; in three dimensions also the bodies with their shapes.
template <class D>
void add_drives(World& world, const Scene& scene, const std::vector<BodySpec>& bodies);

}  // namespace pulvis
