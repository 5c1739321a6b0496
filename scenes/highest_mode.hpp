// What the estimate of the highest frequency starts from (systems/body/highest_mode).
#pragma once

#include "components/shape.hpp"
#include "engine/world.hpp"
#include "scenes/needs.hpp"

namespace pulvis {

// Adds its columns: a first guess of every particle's fastest oscillation, and the springs that its outline
// can have.
void add_highest_mode(World& world, const Bodies& bodies, const Needs& needs);

}  // namespace pulvis
