// Checks of a scene that need more than one key, run once every key is read.
#pragma once

#include "scenes/language/problem.hpp"
#include "scenes/language/table_reader.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// Also fills in the one default that follows from another table: the spacing of a packing of discs.
void complete_and_check(Scene& scene, const schema::Origins& origins, Problems& problems);

}  // namespace pulvis
