// True surfaces of the shapes that have a formula.
#pragma once

#include <memory>

#include "scenes/meshes/hexahedra/star_surface.hpp"

namespace pulvis::space {

std::unique_ptr<StarSurface> round_surface(const SphereShape& shape);
std::unique_ptr<StarSurface> round_surface(const EllipsoidShape& shape);
std::unique_ptr<StarSurface> round_surface(const SuperquadricShape& shape);
std::unique_ptr<StarSurface> round_surface(const CylinderShape& shape);

}  // namespace pulvis::space
