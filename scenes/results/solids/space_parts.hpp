// Results in three dimensions.
#pragma once

#include <memory>
#include <vector>

#include "engine/world.hpp"
#include "scenes/results/parts/result_parts.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis::space {

// `tags`: scenes/results/particle_tags.hpp
std::unique_ptr<ResultParts> result_parts(const Scene& scene, const World& world,
                                          std::vector<ParticleTag> tags);

}  // namespace pulvis::space
