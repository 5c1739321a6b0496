// From where all of an outline is seen.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "scenes/spec/scene.hpp"

namespace pulvis {

// The centre of all points from which every side of a counter-clockwise polygon is seen from inside; empty:
// there are none, or hardly any, or the polygon winds more than once.
std::optional<Vec2> star_centre(const std::vector<Vec2>& polygon);

// Two sides (numbers of their first corners) that cross or touch without being neighbours.
std::optional<std::pair<std::size_t, std::size_t>> crossing_sides(const std::vector<Vec2>& polygon);

}  // namespace pulvis
