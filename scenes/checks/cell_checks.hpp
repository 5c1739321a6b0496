// Periodic cells: checks that a scene's settings are allowed.
#pragma once

#include "scenes/language/problem.hpp"
#include "scenes/language/table_reader.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

void check_cell(const Scene& scene, const schema::Origins& origins, Problems& problems);

}  // namespace pulvis
