// What tells particles apart all through a run: number, material and class. Written once, and no column of the step.
#pragma once

#include <vector>

#include "engine/files/record.hpp"
#include "engine/world.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// By particle number. A size that a packing made is of the class that it was scaled from, a grain of its particle's.
std::vector<ParticleTag> particle_tags(const Scene& scene, const World& world);

}  // namespace pulvis
