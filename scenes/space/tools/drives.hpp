// From a scene's stages to what moves its tools: programme, servos, and what ends a stage early.
#pragma once

#include "scenes/spec/space_scene.hpp"

namespace pulvis::space {

// In which a servo pushes; zero where nothing says it.
Vec3 direction_of(const ServoSpec& servo, const SpaceScene& scene);

}  // namespace pulvis::space
