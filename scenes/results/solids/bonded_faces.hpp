// The faces of particles that are bonded now, and the points of cracks, in three dimensions: fields of the frames.
#pragma once

#include <vector>

#include "engine/world.hpp"

namespace pulvis::space {

// One entry for every face and other body; their meanings are in add_bond_fields.
struct BondedFaces {
  std::vector<double> ids, area, damage, position;
};
BondedFaces bonded_faces(const World& world);

// m, where the points of all cracks are now.
std::vector<double> crack_positions(const World& world);

}  // namespace pulvis::space
