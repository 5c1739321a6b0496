// What a rank finds anew of rows that were given to it.
#pragma once

#include "engine/world.hpp"

namespace pulvis {

// From the keys of the rows and where every slot's begin: their blocks, and which rows or pairs have a particle as the other
// one.
void list_rows(World& world);

// Receives what is under way between two steps, so that no rank waits for another to take it. Collective.
void await_outlines(World& share);

// The border: of the neighbours of its own particles those of other ranks, and the rows that it shares with those ranks.
// Collective; nothing may be under way.
void find_border_again(World& share);

}  // namespace pulvis
