// Likely mistakes that only scenes in three dimensions can have: surfaces too coarse, thin walls, particles beyond a die.
#pragma once

#include <string>
#include <vector>

#include "scenes/spec/scene.hpp"

namespace pulvis::space {

// One line for each warning. The packings must be filled.
std::vector<std::string> solid_warnings(const Scene& scene, const std::vector<BodySpec>& bodies);

}  // namespace pulvis::space
