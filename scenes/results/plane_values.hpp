// Nodal and element values in two dimensions.
#pragma once

#include <vector>

#include "scenes/results/parts/particle_values.hpp"

namespace pulvis {

bool is_plastic_plane(const World& world);
// position, velocity, effective_stress, pressure, stress, and plastic_strain where there is any.
std::vector<ParticleValues> plane_mesh_values(const World& world);

}  // namespace pulvis
