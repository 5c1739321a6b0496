// The surface of a polyline tool, made from the points of its scene.
#pragma once

#include <string>

#include "components/surface.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// What is wrong with a polyline, as "what is wrong, allowed: ..."; empty when it can be made.
std::string fault_of_polyline(const std::vector<Vec2>& points, double rounding);

// Relative to the first point. A corner that points into the powder is cut off where a circle of the
// radius `rounding` touches its two straight parts, and replaced by that circle's arc.
ToolSurface make_surface(const std::vector<Vec2>& points, double rounding);

// The corners of the surface and some points of every arc, in order, relative to the first point.
std::vector<Vec2> drawn_points(const ToolSurface& surface);

}  // namespace pulvis
