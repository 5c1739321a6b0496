// A failure on one rank ends the run on all of them, with one message.
#pragma once

#include <string>

#include "components/ranks.hpp"

namespace pulvis {

// For this rank, in this step: of several failures the first in step-list order is kept. Callable from any thread.
void note_failure(RankLink& link, int position, const std::string& message);

// Call after agree() at the end of a step. Throws RunFailure on all ranks if one has failed: the first failure in
// step-list order, of the lowest rank.
void throw_failure_of_any(RankLink& link);

}  // namespace pulvis
