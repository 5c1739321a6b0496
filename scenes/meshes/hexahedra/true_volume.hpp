// Surface nodes for which a mesh of flat-sided elements has the volume of the true shape.
#pragma once

#include <array>
#include <vector>

#include "scenes/meshes/hexahedra/star_surface.hpp"

namespace pulvis::space {

// Moves nodes from the true surface along its normals: each by what the quads around it cut off, times one common
// factor that makes the total right. Quads: counter-clockwise as seen from outside.
void make_volume_true(std::vector<Vec3>& nodes, const std::vector<std::array<int, 4>>& quads,
                      const StarSurface& surface);

// m^3: between the origin and the bilinear quads over the nodes.
double volume_inside(const std::vector<Vec3>& nodes, const std::vector<std::array<int, 4>>& quads);

}  // namespace pulvis::space
