// Checks of tools that involve more than one key: what each shape requires, and how each may move.
#pragma once

#include "scenes/language/problem.hpp"
#include "scenes/language/table_reader.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

void check_tools(const Scene& scene, const schema::Origins& origins, Problems& problems);

}  // namespace pulvis
