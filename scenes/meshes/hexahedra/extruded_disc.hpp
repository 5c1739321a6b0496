// Mesh of a cylinder: the O-grid of a disc, n * n quads in the middle and rings of 4 n around them (a butterfly), extruded
// along z in m layers.
//
// Its surface has the topology of a cubed sphere of n * n * (m + 2 rings): three faces meet at the eight corners of the
// squares at the ends, four everywhere else, including at the rims.
#pragma once

#include <array>
#include <vector>

#include "scenes/meshes/hexahedra/cubed_sphere.hpp"
#include "scenes/meshes/hexahedra/star_surface.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis::space {

struct ExtrudedDisc {
  std::vector<Vec3> nodes;  // m; surface nodes first
  int surface_nodes = 0;
  std::vector<std::array<int, 4>> quads;  // of the surface, counter-clockwise as seen from outside
  std::vector<Hexahedron> hexahedra;      // layer by layer
};

// Surface nodes lie on `surface`, that of the cylinder; inner nodes are those of the disc's mesh in two dimensions.
ExtrudedDisc extruded_disc(const CylinderShape& cylinder, const HexMeshSpec& mesh,
                           const StarSurface& surface);

}  // namespace pulvis::space
