// How deep a placed outline penetrates a polyline tool: m, > 0 in overlap, exact when they just touch.
#pragma once

#include "components/surface.hpp"
#include "scenes/outlines/outline.hpp"

namespace pulvis {

// Lengths in the tool's frame (see make_surface).
double signed_distance(const ToolSurface& surface, const Vec2& at);  // > 0 in the powder

double depth_in_tool(const ToolSurface& surface, const Vec2& centre, double angle,
                     const RoundedBox& outline);
double depth_in_tool(const ToolSurface& surface, const Vec2& centre, double angle,
                     const std::vector<Vec2>& polygon);  // counter-clockwise

}  // namespace pulvis
