// What a powder does to the wall of a round die.
#pragma once

#include "components/die_room.hpp"
#include "engine/world.hpp"

namespace pulvis::space {

// N, across the wall, of all points of contact: those on opposite sides do not cancel as they do in the force on the die.
// `die`: the tool; `axis`: unit vector.
double normal_force_on_die(const World& world, int die, const DieRoom::Vector& axis);

}  // namespace pulvis::space
