// Settings that have a meaning in two dimensions but not in three.
#pragma once

#include "scenes/language/problem.hpp"

namespace pulvis::space {

// Refuses such keys, tables and words.
void refuse_keys_of_the_plane(const document::Table& root, Problems& problems);

// Refuses solid particles in a scene that does not say that it has three dimensions: nearly all of its keys would be wrong.
void refuse_solids_in_the_plane(const document::Table& root, Problems& problems);

}  // namespace pulvis::space
