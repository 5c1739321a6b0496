// What breaks on one rank ends the run on all of them, with one message.
#pragma once

#include <string>

#include "components/ranks.hpp"

namespace pulvis {

// Of this rank, in this step: of several failures the first in the order of the step list is kept. May be called by any thread.
void note_failure(RankLink& link, int position, const std::string& message);

// After agree() at the end of a step. Throws RunFailure on all ranks where one has failed: what was first in the order of the
// step list, of the lowest rank.
void throw_failure_of_any(RankLink& link);

}  // namespace pulvis
