// Checks of the particle classes of two dimensions: outlines, meshes and grains.
#pragma once

#include <cstdint>

#include "scenes/language/table_reader.hpp"
#include "scenes/spec/material_checks.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// Elements of its mesh; 0 if it consists of grains.
std::int64_t quads_of(const ParticleSpec& particle);

// Also reads the files of outlines, and the numbers of edges from a mesh size.
void complete_outlines(Scene& scene, const schema::Origins& origins, const Refuse& refuse);

}  // namespace pulvis
