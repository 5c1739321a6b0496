// How deep a placed outline reaches into a polyline tool: m, > 0 in overlap, exact when they just touch.
#pragma once

#include "components/surface.hpp"
#include "scenes/scene.hpp"

namespace pulvis {

// Lengths in the tool's frame (see make_surface).
double signed_distance(const ToolSurface& surface, const Vec2& at);  // > 0 in the powder

double disc_depth(const ToolSurface& surface, const Vec2& centre, double radius);
double rectangle_depth(const ToolSurface& surface, const Vec2& centre, double angle,
                       const Vec2& half_size);

}  // namespace pulvis
