// Migration: chunks that move to other ranks during a run.
#pragma once

#include <vector>

#include "engine/world.hpp"

namespace pulvis {

// Between two steps: gives `share` the chunks that `owner` ([chunks], a rank each) assigns to it, with all that a checkpoint
// would store of them, and recomputes its border. Memory of chunks that were given away is freed. The results do not change
// by a bit. Collective. The graphs of a step refer to the old chunks: they must be rebuilt.
void migrate(World& share, const std::vector<int>& owner);

}  // namespace pulvis
