// Checks of the particle classes of three dimensions: shapes and meshes.
#pragma once

#include "scenes/spec/material_checks.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis::space {

// Also reads the STL files of particles and tools.
void complete_solids(Scene& scene, const Refuse& refuse);

}  // namespace pulvis::space
