// Sizes of a particle's shape that do not go together. `path`: that of the particle.
#pragma once

#include "scenes/spec/material_checks.hpp"
#include "scenes/spec/space_scene.hpp"

namespace pulvis::space {

void check_shape(const ParticleShape& shape, const std::string& path, const Refuse& refuse);

}  // namespace pulvis::space
