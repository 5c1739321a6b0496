// Checks of a scene of particles that involve more than one key, run once all keys have been read.
#pragma once

#include "scenes/language/problem.hpp"
#include "scenes/language/table_reader.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// Also fills in what follows from other tables or files: the spacing of touching particles, outlines, surfaces.
void complete_and_check(Scene& scene, const schema::Origins& origins, Problems& problems);

}  // namespace pulvis
