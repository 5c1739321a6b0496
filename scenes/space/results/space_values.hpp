// Node and element values in three dimensions.
#pragma once

#include <vector>

#include "scenes/results/parts/particle_values.hpp"

namespace pulvis::space {

bool is_plastic(const World& world);
// position, velocity, effective_stress, pressure, stress, and plastic_strain if it exists.
std::vector<ParticleValues> mesh_values(const World& world);

}  // namespace pulvis::space
