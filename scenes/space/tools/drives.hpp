// Columns and tool motion from a scene's tools and stages: programme, servos, and conditions that end a stage early.
#pragma once

#include "engine/world.hpp"
#include "scenes/spec/space_scene.hpp"

namespace pulvis::space {

// The direction in which a servo pushes; zero if unspecified.
Vec3 direction_of(const ServoSpec& servo, const Scene& scene);

// The world must have its bodies with their shapes.
void add_tools(World& world, const Scene& scene, const std::vector<BodySpec>& bodies);

}  // namespace pulvis::space
