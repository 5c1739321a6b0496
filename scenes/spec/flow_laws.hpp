// Checks of a material's flow laws that involve more than one key.
#pragma once

#include <filesystem>

#include "scenes/language/table_reader.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// Reads the hardening tables, makes every law start at its material's yield stress, and refuses inconsistent
// input. A material whose law turns out to be linear then has no `flow`.
void complete_flow_laws(Scene& scene, const schema::Origins& origins, Problems& problems);

}  // namespace pulvis
