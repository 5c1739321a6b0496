// Which tools are driven by a force, and which through a spring, in any stage.
#pragma once

#include "scenes/spec/scene.hpp"

namespace pulvis {

bool is_servo_driven(const Scene& scene, int tool);
bool is_driven_through_a_spring(const Scene& scene, int tool);
// Either of them, for any tool.
bool has_servos(const Scene& scene);

}  // namespace pulvis
