// The volume below the crests of a die's bottom, where it is a target surface: part of the volume between
// the tools.
#pragma once

#include "components/relief.hpp"
#include "components/surface.hpp"
#include "engine/world.hpp"

namespace pulvis {

// Arcs are replaced by chords: docs/results.md gives the error.
Relief relief_of(const ToolSurface& surface);
Relief relief_of(const World& world, int tool);  // empty for a plane

}  // namespace pulvis
