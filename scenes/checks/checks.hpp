// Checks of a scene that involve more than one key, run once all keys have been read.
#pragma once

#include "scenes/language/problem.hpp"
#include "scenes/language/table_reader.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// Also fills in the one default that depends on another table: the spacing of a packing of discs.
void complete_and_check(Scene& scene, const schema::Origins& origins, Problems& problems);

}  // namespace pulvis
