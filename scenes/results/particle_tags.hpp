// Identifies particles throughout a run: number, material and class. Written once; not a column of the step.
#pragma once

#include <vector>

#include "engine/files/record.hpp"
#include "engine/world.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// By particle number. A size made by a packing has the class that it was scaled from, a grain that of its particle.
std::vector<ParticleTag> particle_tags(const Scene& scene, const World& world);

}  // namespace pulvis
