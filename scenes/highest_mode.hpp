// Initial values for the estimate of the highest frequency (systems/body/highest_mode).
#pragma once

#include "components/shape.hpp"
#include "engine/world.hpp"
#include "scenes/needs.hpp"

namespace pulvis {

// Adds its columns: an initial guess of every particle's fastest mode, and the springs that can act on
// its outline.
void add_highest_mode(World& world, const Bodies& bodies, const Needs& needs);

}  // namespace pulvis
