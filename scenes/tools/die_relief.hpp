// What a die's bottom leaves below its crests, where it is a target surface: it belongs to the volume between
// the tools.
#pragma once

#include "components/relief.hpp"
#include "components/surface.hpp"
#include "engine/world.hpp"

namespace pulvis {

// With arcs as chords: docs/results.md gives the error.
Relief relief_of(const ToolSurface& surface);
Relief relief_of(const World& world, int tool);  // empty for a plane

}  // namespace pulvis
