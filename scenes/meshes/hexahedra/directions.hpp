// Quadrature over all directions from the centre of a star-shaped surface.
#pragma once

#include <vector>

#include "scenes/meshes/hexahedra/star_surface.hpp"

namespace pulvis::space {

struct Direction {
  Vec3 unit;
  double weight;  // solid angle that it represents; the sum is 4 pi
};
// 6 * cells^2 equiangular cells, four Gauss points each.
std::vector<Direction> directions(int cells);

// m^3; m, relative to the origin: sums over `directions(cells)`.
double volume_about(const StarSurface& surface, int cells);
Vec3 centre_of_volume(const StarSurface& surface, int cells);

}  // namespace pulvis::space
