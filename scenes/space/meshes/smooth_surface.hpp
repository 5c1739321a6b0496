// The smooth surface of a particle's mesh: four-sided bicubic Bezier patches, one on each outer side of an element, whose
// points are combinations of surface nodes.
//
// Net       y_i = x_i - c_i U_i, U_i = 4/m sum_k (x_k - x_i) over the m nodes k that share an edge with i. The undeformed
//           surface passes where the true one is when c is right; c = 1/12 where the spacing is fine, as in two
//           dimensions, for nodes that stand on the mesh of equal volume.
// Regular   about nodes where four faces meet the surface is the uniform bicubic B-spline of y: C2.
// Irregular about the eight nodes v where three faces meet the patches share tangent planes (G1) exactly, whatever the
//           deformation. Across the side from v to a node w the patches A and B have A_v + B_v = -(1-u)^2 A_u and the side
//           is quadratic; the place of v and the inner points beside it follow, since the number of faces is odd. The
//           derivative along the line through v and w is, at w, a times that of the spline plus b U_w: with the right
//           a and b the undeformed surface is as close to the true one there as elsewhere, and C1. On a cube of six faces
//           -(1-2u) takes the place of -(1-u)^2, and sides are cubic.
//           (Of such conditions: Peters, Geometric continuity, Handbook of CAGD, 2002; these are for three faces alone.)
#pragma once

#include "components/space/shape.hpp"
#include "scenes/space/meshes/star_surface.hpp"

namespace pulvis::space {

// Fills faces, points and their terms; stiffness needs the elements' volumes.
void complete_surface(Shape& shape, const StarSurface& surface);

}  // namespace pulvis::space
