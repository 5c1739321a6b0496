// Moves the nodes of a mesh so that its hexahedra approach cubes of equal size.
#pragma once

#include <vector>

#include "scenes/meshes/hexahedra/cubed_sphere.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis::space {

// Minimises the mean of (1 - w) (|a|^2 + |b|^2 + |c|^2)^(3/2) / (3^(3/2) d) + w (d + 1/d)/2 over all element corners,
// with the edges a, b, c at a corner and their triple product d, in units of a cube of mean volume; w = size_share.
//
// Source: Garanzha et al. (2021), see scenes/meshes/descent.hpp; with corners of hexahedra instead of tetrahedra.
struct Smoothing {
  double size_share = 0.5;
  int max_iterations = 100;
};

// The first `fixed` nodes do not move. Returns the mean, 1 for equal cubes.
double smooth_hexahedra(std::vector<Vec3>& nodes, const std::vector<Hexahedron>& hexahedra,
                        int fixed, const Smoothing& how);

// m^3: the minimum triple product of the edges at a corner.
double least_corner(const std::vector<Vec3>& nodes, const std::vector<Hexahedron>& hexahedra);

}  // namespace pulvis::space
