// What a rank rebuilds for rows that were assigned to it.
#pragma once

#include "engine/world.hpp"

namespace pulvis {

// From the keys of the rows and each slot's first row: their blocks, and which rows or pairs have a particle as the
// other one.
void list_rows(World& world);

// Receives the messages in flight between two steps, so that no rank waits for another to receive them. Collective.
void await_outlines(World& share);

// The border: neighbours of this rank's particles that are on other ranks, and the rows shared with those ranks.
// Collective; no message may be in flight.
void find_border_again(World& share);

}  // namespace pulvis
