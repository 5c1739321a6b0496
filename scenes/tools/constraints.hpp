// Constraints of a scene: which nodes they hold.
#pragma once

#include <functional>
#include <vector>

#include "engine/world.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

inline bool is_constraint(const ToolSpec& tool) {
  return tool.shape == ToolSpec::Shape::constraint;
}

// m, undeformed node positions of the particle in a slot.
using NodePlaces = std::function<std::vector<Vec2>(int slot)>;

// Adds the constrained nodes to a world that has its bodies; a rank holds those of its own particles. Throws SceneError where
// a constraint holds nothing, or something that it cannot hold.
void add_constraints(World& world, const Scene& scene, const NodePlaces& places_of);

}  // namespace pulvis
