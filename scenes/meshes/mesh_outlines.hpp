// One mesher per outline (scenes/meshes/mesh_<outline>.cpp): each fills nodes, quads, the number of boundary
// nodes and the contact curve of a shape whose area is known. `phase` rotates the mesh inside the outline (rad), where it
// can. `curve`: the outline's.
#pragma once

#include "components/shape.hpp"
#include "scenes/outlines/curve_of.hpp"
#include "scenes/outlines/outline_curve.hpp"

namespace pulvis {

void mesh_outline(const DiscOutline& disc, const DiscMesh& mesh, double phase, Shape& shape);
void mesh_outline(const RectangleOutline& rectangle, const RectangleMesh& mesh, double phase,
                  Shape& shape);
void mesh_outline(const RoundedRectangleOutline& rectangle, const RoundedRectangleMesh& mesh,
                  double phase, Shape& shape);
void mesh_outline(const RingOutline& ring, const RingMesh& mesh, double phase, Shape& shape);

// The nodes of a grain coincide with those of its neighbours.
void mesh_outline(const GrainOutline& grain, const OutlineCurve& curve, const StarMesh& mesh,
                  Shape& shape);

// For every outline that is a curve; its mesh cannot be rotated.
void mesh_star(const OutlineCurve& curve, const StarMesh& mesh, Shape& shape);
template <class Curved>
requires requires(const Curved& outline) { curve_of(outline); }
void mesh_outline(const Curved&, const OutlineCurve& curve, const StarMesh& mesh, Shape& shape) {
  mesh_star(curve, mesh, shape);
}

}  // namespace pulvis
