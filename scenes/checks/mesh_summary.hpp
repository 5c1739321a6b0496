// What `check` says of the meshes.
#pragma once

#include <string>

#include "scenes/spec/scene.hpp"

namespace pulvis {

// A line for each class of particles.
std::string mesh_summary(const Scene& scene);

}  // namespace pulvis
