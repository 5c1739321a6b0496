// Triangles from the STL files that particles and tools refer to.
#pragma once

#include "scenes/language/table_reader.hpp"
#include "scenes/spec/material_checks.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis::space {

// For particles, relative to their centre of volume and scaled to their diameter.
void read_stl_files(Scene& scene, const Refuse& refuse);

}  // namespace pulvis::space
