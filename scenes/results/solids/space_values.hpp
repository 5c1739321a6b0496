// Fields of nodes and elements in three dimensions.
#pragma once

#include <vector>

#include "scenes/results/parts/particle_values.hpp"

namespace pulvis::space {

std::vector<MeshField> mesh_fields(const World& world);

}  // namespace pulvis::space
