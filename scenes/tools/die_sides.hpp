// The tools on the four sides of a powder.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "scenes/spec/scene.hpp"

namespace pulvis {

// Out of a plane, or of the side of a polyline or profile that most of it faces; no constraint's.
Vec2 face_normal(const ToolSpec& tool);

// Tools: left, right, bottom, top. A plane stands on the side that its normal looks away from, which must be
// an axis; a polyline on the one that its chord looks away from most. Constraints
// touch nothing and stand nowhere. None unless there is just one tool on each side.
using DieSides = std::array<int, 4>;
std::optional<DieSides> die_sides(const Scene& scene);

}  // namespace pulvis
