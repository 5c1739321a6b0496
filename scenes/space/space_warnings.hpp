// What a scene in three dimensions may have wrong though each of its values is allowed.
#pragma once

#include <string>
#include <vector>

#include "scenes/spec/space_scene.hpp"

namespace pulvis::space {

// One line each. The packings are filled.
std::vector<std::string> setup_warnings(const Scene& scene, const std::vector<BodySpec>& bodies);

}  // namespace pulvis::space
