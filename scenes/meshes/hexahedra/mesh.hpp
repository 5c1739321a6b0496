// Meshes of particles in three dimensions, and their smooth surfaces.
#pragma once

#include "components/space/shape.hpp"
#include "scenes/meshes/hexahedra/star_surface.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis::space {

// The undeformed shape of a particle class: its mesh has the volume of the true shape, its smooth surface lies on the true
// one. Throws std::invalid_argument if no mesh without folded elements was found.
Shape make_shape(const ParticleSpec& particle);

}  // namespace pulvis::space
