// What `check` reports about the meshes.
#pragma once

#include <string>

#include "scenes/spec/scene.hpp"

namespace pulvis {

// One line for each particle class.
std::string mesh_summary(const Scene& scene);

}  // namespace pulvis
