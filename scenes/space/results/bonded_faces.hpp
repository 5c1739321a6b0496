// The faces of particles that are bonded now, in three dimensions: fields of the frames.
#pragma once

#include <vector>

#include "engine/world.hpp"

namespace pulvis::space {

// ids, area, damage, position: see bond_fields. One entry for every face and other body.
void append_bonded_faces(const World& world, std::vector<std::vector<double>>& fields);

}  // namespace pulvis::space
