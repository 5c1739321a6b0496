// History series in three dimensions that replace those of two dimensions.
#pragma once

#include <vector>

#include "engine/files/record.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis::space {

std::vector<SeriesInfo> tool_series(const Scene& scene);  // of tools, and of the room between them
std::vector<SeriesInfo> contact_series();
std::vector<SeriesInfo> momentum_series();
bool is_servo_driven(const Scene& scene, int tool);
bool is_driven_through_a_spring(const Scene& scene, int tool);

}  // namespace pulvis::space
