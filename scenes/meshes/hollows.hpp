// The inner boundaries of meshes with holes.
#pragma once

#include "components/hollow.hpp"
#include "components/shape.hpp"

namespace pulvis {

std::vector<Hollows::Loop> hollows_of(const Shape& shape);

}  // namespace pulvis
