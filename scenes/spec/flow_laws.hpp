// What the keys of a material's flow laws do not say each for itself.
#pragma once

#include <filesystem>

#include "scenes/language/table_reader.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// Reads the tables of hardening, lets every law begin at its material's yield stress, and refuses what does not fit
// together. A material whose law is linear after all has no `flow` then.
void complete_flow_laws(Scene& scene, const schema::Origins& origins, Problems& problems);

}  // namespace pulvis
