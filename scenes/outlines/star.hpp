// The region from which an entire outline is visible.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "scenes/spec/scene.hpp"

namespace pulvis {

// The centroid of all points from which every side of a counter-clockwise polygon is visible; empty:
// there are none, or hardly any, or the polygon winds more than once.
std::optional<Vec2> star_centre(const std::vector<Vec2>& polygon);

// Two sides (indices of their first corners) that cross or touch without being neighbours.
std::optional<std::pair<std::size_t, std::size_t>> crossing_sides(const std::vector<Vec2>& polygon);

}  // namespace pulvis
