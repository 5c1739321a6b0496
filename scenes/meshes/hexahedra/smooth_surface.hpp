// The smooth surface of a particle's mesh: bicubic quadrilateral Bezier patches, one on each outer element face, whose
// points are linear combinations of surface nodes.
//
// Net       y_i = x_i - c_i U_i, U_i = 4/m sum_k (x_k - x_i) over the m nodes k that share an edge with i. The undeformed
//           surface passes through the true one if c is right; c = 1/12 for fine spacing, as in two
//           dimensions, for nodes on the mesh of equal volume.
// Regular   around nodes where four faces meet, the surface is the uniform bicubic B-spline of y: C2.
// Irregular around the eight nodes v where three faces meet, the patches share tangent planes (G1) exactly, whatever the
//           deformation. Across the side from v to a node w the patches A and B have A_v + B_v = -(1-u)^2 A_u and the side
//           is quadratic; the position of v and the inner points next to it follow, since the number of faces is odd. The
//           derivative along the line through v and w is, at w, a times that of the spline plus b U_w: with the right
//           a and b the undeformed surface is as close to the true one there as elsewhere, and C1. On a cube of six faces,
//           -(1-2u) replaces -(1-u)^2, and sides are cubic.
//           (On such conditions: Peters, Geometric continuity, Handbook of CAGD, 2002; these hold for three faces only.)
#pragma once

#include "components/space/shape.hpp"
#include "scenes/meshes/hexahedra/star_surface.hpp"

namespace pulvis::space {

// Fills faces, points and their terms; the stiffness requires the elements' volumes.
void complete_surface(Shape& shape, const StarSurface& surface);

}  // namespace pulvis::space
