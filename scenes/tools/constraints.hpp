// Constraints of a scene: which nodes they hold.
#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <vector>

#include "engine/entry.hpp"
#include "engine/world.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

inline bool is_constraint(const ToolSpec& tool) {
  return tool.shape == ToolSpec::Shape::constraint;
}

// Whether a constraint holds its nodes along this axis.
inline bool holds_axis(ToolSpec::Holds holds, int axis) {
  using Holds = ToolSpec::Holds;
  static constexpr std::array of_axis{Holds::x, Holds::y, Holds::z};
  return holds == Holds::both || holds == Holds::all || holds == entry(of_axis, axis);
}

// Whether particles can touch a tool.
inline bool has_contact_tools(const Scene& scene) {
  return !std::ranges::all_of(scene.tools, is_constraint);
}

// m, the tool position in the history; for a constraint, the centre of its box, or its centre.
Vec3 start_of(const ToolSpec& tool);

// m, undeformed node positions of the particle in a slot.
using NodePlaces = std::function<std::vector<Vec3>(int slot)>;

// Adds the constrained nodes to a world that has its bodies; a rank holds those of its own particles. Throws SceneError where
// a constraint holds nothing, or something that it cannot hold.
template <class D>
void add_constraints(World& world, const Scene& scene, const NodePlaces& places_of);

}  // namespace pulvis
