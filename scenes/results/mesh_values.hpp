// The values of particles in two and three dimensions.
#pragma once

#include <vector>

#include "scenes/results/parts/particle_values.hpp"

namespace pulvis {

// Fields of the mesh, in the order of ResultParts::fields, of which they are the first.
std::vector<ParticleValues> mesh_values(const World& world);
// What the next step starts from: positions, velocities, plastic state.
ParticleValues state_values();

// Of all particles by number, one after the other.
void visit_all(const World& world, const ParticleValues& values, const ValueSink& take);

}  // namespace pulvis
