// Likely mistakes in a scene in three dimensions whose values are all allowed.
#pragma once

#include <string>
#include <vector>

#include "scenes/spec/space_scene.hpp"

namespace pulvis::space {

// One line for each warning. The packings must be filled.
std::vector<std::string> setup_warnings(const Scene& scene, const std::vector<BodySpec>& bodies);

}  // namespace pulvis::space
