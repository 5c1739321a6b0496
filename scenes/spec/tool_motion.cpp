#include "scenes/spec/tool_motion.hpp"

#include <algorithm>

namespace pulvis {

bool is_servo_driven(const Scene& scene, int tool) {
  return std::ranges::any_of(scene.stages, [&](const StageSpec& stage) {
    return std::ranges::find(stage.servos, tool, &ServoSpec::tool) != stage.servos.end();
  });
}

bool is_driven_through_a_spring(const Scene& scene, int tool) {
  return std::ranges::any_of(scene.stages, [&](const StageSpec& stage) {
    return std::ranges::any_of(
        stage.moves, [&](const MoveSpec& move) { return move.tool == tool && move.stiffness; });
  });
}

bool has_servos(const Scene& scene) {
  return std::ranges::any_of(scene.stages, [](const StageSpec& stage) {
    return !stage.servos.empty() || std::ranges::any_of(stage.moves, [](const MoveSpec& move) {
      return move.stiffness.has_value();
    });
  });
}

}  // namespace pulvis
