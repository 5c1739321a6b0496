// Initial values for the estimate of the highest frequency (systems/body/highest_mode.hpp).
#pragma once

#include "components/shape.hpp"
#include "components/space/shape.hpp"
#include "engine/world.hpp"

namespace pulvis {

// Adds its columns: an initial guess of every particle's fastest mode, and the springs that can act on
// its outline, or surface, if contact is possible.
void add_highest_mode(World& world, const Bodies& bodies, bool contact);
void add_highest_mode(World& world, const Bodies& bodies, const space::Shapes& shapes,
                      bool contact);

}  // namespace pulvis
