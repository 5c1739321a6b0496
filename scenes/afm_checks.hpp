// Checks of an AFM scene that need more than one key.
#pragma once

#include "scenes/problem.hpp"
#include "scenes/scene.hpp"
#include "scenes/table_reader.hpp"

namespace pulvis {

void check_afm(const Scene& scene, const schema::Origins& origins, Problems& problems);

}  // namespace pulvis
