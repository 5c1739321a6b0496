// The true surface of a convex polyhedron with rounded edges: all points within `rounding` of a smaller polyhedron.
#pragma once

#include <memory>
#include <optional>

#include "scenes/meshes/hexahedra/star_surface.hpp"

namespace pulvis::space {

// Throws std::invalid_argument if the rounding leaves nothing.
std::unique_ptr<StarSurface> polyhedron_surface(const PolyhedronShape& shape);

// m, the radius of the largest sphere inside, if the rounding is not below it.
std::optional<double> too_round(const PolyhedronShape& shape);

// Its centre of volume, in the frame of its corners, m.
Vec3 centre_of(const PolyhedronShape& shape);

}  // namespace pulvis::space
