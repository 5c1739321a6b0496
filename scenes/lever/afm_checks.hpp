// Checks of an AFM scene that involve more than one key.
#pragma once

#include "scenes/language/problem.hpp"
#include "scenes/language/table_reader.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

void check_afm(const Scene& scene, const schema::Origins& origins, Problems& problems);

}  // namespace pulvis
