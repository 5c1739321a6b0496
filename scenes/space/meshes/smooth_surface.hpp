// The smooth surface of a particle's mesh: four-sided bicubic Bezier patches, one on each outer side of an element, whose
// points are combinations of surface nodes.
//
// Net       y_i = x_i - c_i U_i, U_i = 4/m sum_k (x_k - x_i) over the m nodes k that share an edge with i. The undeformed
//           surface passes where the true one is when c is right; c = 1/12 where the spacing is fine, as in two
//           dimensions, for nodes that stand on the mesh of equal volume.
// Regular   about nodes where four faces meet the surface is the uniform bicubic B-spline of y: C2.
// Irregular about the eight nodes where three faces meet the patches share tangent planes (G1) exactly, whatever the
//           deformation: across the side from such a node, A_v + B_v = -(1-u)^2 A_u with a quadratic side; the odd
//           number of faces determines the inner points. With n = 1 (three faces about every node): -(1-2u) A_u.
//           (The conditions are those of Peters, Bicubic G1 splines; here for valence 3 alone.)
#pragma once

#include "components/space/shape.hpp"
#include "scenes/space/meshes/star_surface.hpp"

namespace pulvis::space {

// Fills faces, points and their terms; stiffness needs the elements' volumes.
void complete_surface(Shape& shape, const StarSurface& surface);

}  // namespace pulvis::space
