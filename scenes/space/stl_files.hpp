// Triangles of the STL files that particles and tools name.
#pragma once

#include "scenes/language/table_reader.hpp"
#include "scenes/spec/material_checks.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis::space {

// Of particles about their centre of volume, and as large as their diameter says.
void read_stl_files(Scene& scene, const Refuse& refuse);

}  // namespace pulvis::space
