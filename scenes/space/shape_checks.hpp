// Sizes of a particle's shape that do not go together. `path`: that of the particle.
#pragma once

#include "scenes/spec/material_checks.hpp"
#include "scenes/spec/space_scene.hpp"

namespace pulvis::space {

void check_shape(const ParticleShape& shape, const std::string& path, const Refuse& refuse);

// The disc's square has no node of four faces between its corners with one division; a rim that is rounded by more than half
// an element is as flat as the element's faces beside it.
void check_extruded(const CylinderShape& cylinder, const MeshSpec& mesh, const std::string& path,
                    const Refuse& refuse);

}  // namespace pulvis::space
