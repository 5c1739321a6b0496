// Grips of a scene: which nodes they hold.
#pragma once

#include "engine/world.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

inline bool is_grip(const ToolSpec& tool) { return tool.shape == ToolSpec::Shape::grip; }

// Adds the gripped nodes to a world whose bodies are placed. Throws SceneError where a grip holds nothing,
// or what it cannot hold.
void add_grips(World& world, const Scene& scene);

}  // namespace pulvis
