// Checks of tools, their moves and servos, and of conditions that end a stage early.
#pragma once

#include "scenes/language/table_reader.hpp"
#include "scenes/spec/material_checks.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis::space {

void check_tools(const Scene& scene, const schema::Origins& origins, const Refuse& refuse);

}  // namespace pulvis::space
