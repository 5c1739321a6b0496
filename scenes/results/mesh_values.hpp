// Per-particle values in two and three dimensions.
#pragma once

#include <vector>

#include "scenes/results/parts/particle_values.hpp"

namespace pulvis {

// Fields of the mesh; they come first in Results::fields, in this order.
std::vector<MeshField> mesh_fields(const World& world);
std::vector<ParticleValues> mesh_values(const World& world);
// The initial state of the next step: positions, velocities, plastic state.
ParticleValues state_values();

// All particles in order of number, one after the other.
void visit_all(const World& world, const ParticleValues& values, const ValueSink& take);

}  // namespace pulvis
