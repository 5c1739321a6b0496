// From a scene's tools and stages to columns and to what moves the tools: programme, servos, and what ends a stage early.
#pragma once

#include "engine/world.hpp"
#include "scenes/spec/space_scene.hpp"

namespace pulvis::space {

// In which a servo pushes; zero where nothing says it.
Vec3 direction_of(const ServoSpec& servo, const SpaceScene& scene);

// Whether in some stage a tool holds a force, or is moved by a drive that gives.
bool has_servos(const SpaceScene& scene);

// The world has its bodies with their shapes.
void add_tools(World& world, const Scene& scene, const std::vector<BodySpec>& bodies);

}  // namespace pulvis::space
