// Constraints of a scene: which nodes they hold.
#pragma once

#include "engine/world.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

inline bool is_constraint(const ToolSpec& tool) {
  return tool.shape == ToolSpec::Shape::constraint;
}

// Adds the constrained nodes to a world whose bodies are placed. Throws SceneError where a constraint holds nothing,
// or what it cannot hold.
void add_constraints(World& world, const Scene& scene);

}  // namespace pulvis
