// Settings that exist in the other dimension only.
#pragma once

#include "scenes/language/problem.hpp"

namespace pulvis {

// Refuses keys, tables and words that scenes of this dimension do not have, but those of the other one do.
void refuse_keys_of_other_dimension(const document::Table& root, Problems& problems);

}  // namespace pulvis
