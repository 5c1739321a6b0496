// The faces of particles that are bonded now, and the points of cracks, in three dimensions: fields of the frames.
#pragma once

#include <vector>

#include "engine/world.hpp"

namespace pulvis::space {

// ids, area, damage, position: see bond_fields. One entry for every face and other body. Then the positions of the cracks.
void append_bonded_faces(const World& world, std::vector<std::vector<double>>& fields);

}  // namespace pulvis::space
