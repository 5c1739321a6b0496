// The true surface of a star-shaped body of triangles.
#pragma once

#include <memory>

#include "scenes/space/meshes/star_surface.hpp"

namespace pulvis::space {

// Throws std::invalid_argument where the centre of its volume does not see all of it.
std::unique_ptr<StarSurface> triangle_surface(const StlShape& shape);

}  // namespace pulvis::space
