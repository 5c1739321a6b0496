// Checks of a scene that need more than one key, run once every key is read.
#pragma once

#include "scenes/problem.hpp"
#include "scenes/scene.hpp"
#include "scenes/table_reader.hpp"

namespace pulvis {

// Also fills in the one default that follows from another table: the spacing of a packing of discs.
void complete_and_check(Scene& scene, const schema::Origins& origins, Problems& problems);

}  // namespace pulvis
