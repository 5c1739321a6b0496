// Incompatible dimensions of a particle's shape. `path`: that of the particle.
#pragma once

#include "scenes/spec/material_checks.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis::space {

void check_shape(const ParticleShape& shape, const std::string& path, const Refuse& refuse);

// With one division, the disc's square has no four-face node between its corners; a rim rounded by more than half
// an element is as flat as the element faces next to it.
void check_extruded(const CylinderShape& cylinder, const HexMeshSpec& mesh, const std::string& path,
                    const Refuse& refuse);

}  // namespace pulvis::space
