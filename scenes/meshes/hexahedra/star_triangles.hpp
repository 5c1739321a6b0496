// The true surface of a star-shaped body made of triangles.
#pragma once

#include <memory>

#include "scenes/meshes/hexahedra/star_surface.hpp"

namespace pulvis::space {

// Throws std::invalid_argument if the surface is not star-shaped about its centre of volume.
std::unique_ptr<StarSurface> triangle_surface(const StlShape& shape);

}  // namespace pulvis::space
