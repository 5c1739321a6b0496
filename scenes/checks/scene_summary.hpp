// What `check` and `pack` report about packings and meshes.
#pragma once

#include <string>

#include "scenes/spec/scene.hpp"

namespace pulvis {

std::string packing_summary(const Scene& scene);  // one line for each random packing
std::string mesh_summary(const Scene& scene);     // one line for each particle class

}  // namespace pulvis
