// The bodies that the surface of an STL file encloses.
#pragma once

#include <array>
#include <vector>

#include "scenes/spec/scene.hpp"

namespace pulvis::space {

// For a closed surface, in the unit of its file. Throws BadStl if bodies touch or overlap, or if a surface faces inwards that
// is not the wall of a cavity: hidden faces inside a solid would be nearest to what penetrates it, and push it sideways.
void refuse_touching_bodies(const std::vector<std::array<Vec3, 3>>& triangles);

}  // namespace pulvis::space
