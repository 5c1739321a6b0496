// The contact surfaces of a scene's tools.
#pragma once

#include "components/space/tools.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis::space {

ToolShapes tool_shapes(const Scene& scene);

// The meridian of a punch about its axis (x: radius, y: height above its point): the profile, or a flat face, on both sides
// of the axis. Beyond its rim it continues outward if the punch fills its die (`open`), otherwise its side goes down there.
ToolSurface punch_meridian(const ToolSpec& punch, bool open);

}  // namespace pulvis::space
