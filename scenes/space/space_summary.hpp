// What `pulvis check` reports about packings and meshes in three dimensions.
#pragma once

#include <string>

#include "scenes/spec/scene.hpp"

namespace pulvis::space {

std::string packing_summary(const Scene& scene);
std::string mesh_summary(const Scene& scene);

}  // namespace pulvis::space
