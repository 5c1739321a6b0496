// Fields of nodes and elements in two dimensions.
#pragma once

#include <vector>

#include "scenes/results/parts/particle_values.hpp"

namespace pulvis {

std::vector<MeshField> plane_mesh_fields(const World& world);

}  // namespace pulvis
