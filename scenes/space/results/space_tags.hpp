// What tells particles apart all through a run: number, material and class.
#pragma once

#include <vector>

#include "engine/files/record.hpp"
#include "engine/world.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis::space {

// By particle number. A size that a packing made is of the class that it was scaled from.
std::vector<ParticleTag> particle_tags(const Scene& scene, const World& world);

}  // namespace pulvis::space
