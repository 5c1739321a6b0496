// The tools on the four sides of a powder.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "scenes/spec/scene.hpp"

namespace pulvis {

// Outward normal of a plane, or of the side that most of a polyline faces; not for constraints.
Vec2 face_normal(const ToolSpec& tool);

// Tools: left, right, bottom, top. A plane belongs to the side opposite to its normal, which must be
// along an axis; a polyline to the one opposite to its chord's normal. Constraints
// touch nothing and are on no side. Empty unless there is exactly one tool on each side.
using DieSides = std::array<int, 4>;
std::optional<DieSides> die_sides(const Scene& scene);

}  // namespace pulvis
