// The surface of a polyline tool, made from the points in the scene.
#pragma once

#include <string>

#include "components/surface.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// What is wrong with a polyline, as "what is wrong, allowed: ..."; empty if it is valid.
std::string fault_of_polyline(const std::vector<Vec2>& points, double rounding);

// Relative to the first point. A corner that points into the powder is rounded by a circular arc of
// radius `rounding` tangent to its two straight segments.
ToolSurface make_surface(const std::vector<Vec2>& points, double rounding);

// The corners of the surface and some points of every arc, in order, relative to the first point.
std::vector<Vec2> drawn_points(const ToolSurface& surface);

}  // namespace pulvis
