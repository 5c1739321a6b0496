// From packings and bodies to single particles.
#pragma once

#include <vector>

#include "scenes/spec/space_scene.hpp"

namespace pulvis::space {

// Every particle of the scene, in the order of the file.
std::vector<BodySpec> place_bodies(const Scene& scene);

}  // namespace pulvis::space
