// Checks of tools that need more than one key: what each shape asks for, and how each may move.
#pragma once

#include "scenes/problem.hpp"
#include "scenes/scene.hpp"
#include "scenes/table_reader.hpp"

namespace pulvis {

void check_tools(const Scene& scene, const schema::Origins& origins, Problems& problems);

}  // namespace pulvis
