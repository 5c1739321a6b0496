// Results in three dimensions.
#pragma once

#include <memory>

#include "engine/world.hpp"
#include "scenes/results/parts/result_parts.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis::space {

std::unique_ptr<ResultParts> result_parts(const Scene& scene, const World& world);

}  // namespace pulvis::space
