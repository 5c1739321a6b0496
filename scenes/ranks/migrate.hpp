// Migration: chunks that go to other ranks while a run goes on.
#pragma once

#include <vector>

#include "engine/world.hpp"

namespace pulvis {

// Between two steps: gives `share` the chunks that are its own by `owner` ([chunks], a rank each), with all that a checkpoint
// would keep of them, and finds its border anew. What a chunk that was given away held takes no memory any more. No bit of
// the run depends on it. Collective. The graphs of a step are of the chunks before: they have to be made anew.
void migrate(World& share, const std::vector<int>& owner);

}  // namespace pulvis
