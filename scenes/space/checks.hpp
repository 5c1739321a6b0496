// Checks of a scene in three dimensions that involve more than one key, once all keys are read.
#pragma once

#include "scenes/language/problem.hpp"
#include "scenes/language/table_reader.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis::space {

// Also fills in what follows from other keys: the axis of a die, the spacing of spheres.
void complete_and_check(Scene& scene, const schema::Origins& origins, Problems& problems);

}  // namespace pulvis::space
