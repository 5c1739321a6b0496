// Load of the powder on the wall of a round die.
#pragma once

#include "components/die_room.hpp"
#include "engine/world.hpp"

namespace pulvis::space {

// N, normal to the wall, summed over all contact points: unlike in the resultant force on the die, opposite sides add up.
// `die`: the tool; `axis`: unit vector.
double normal_force_on_die(const World& world, int die, const DieRoom::Vector& axis);

}  // namespace pulvis::space
