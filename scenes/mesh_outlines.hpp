// One mesher an outline (scenes/mesh_<outline>.cpp): each fills the nodes, the quads, the number of boundary
// nodes and the contact curve of a shape. `phase` turns the mesh inside the outline (rad), where it can.
#pragma once

#include "components/shape.hpp"
#include "scenes/scene.hpp"

namespace pulvis {

void mesh_outline(const DiscOutline& disc, const DiscMesh& mesh, double phase, Shape& shape);
void mesh_outline(const RectangleOutline& rectangle, const RectangleMesh& mesh, double phase,
                  Shape& shape);
void mesh_outline(const RoundedRectangleOutline& rectangle, const RoundedRectangleMesh& mesh,
                  double phase, Shape& shape);
void mesh_outline(const RingOutline& ring, const RingMesh& mesh, double phase, Shape& shape);
void mesh_outline(const EllipseOutline& outline, const StarMesh& mesh, double phase, Shape& shape);
void mesh_outline(const SuperellipseOutline& outline, const StarMesh& mesh, double phase,
                  Shape& shape);
void mesh_outline(const PolygonOutline& outline, const StarMesh& mesh, double phase, Shape& shape);
void mesh_outline(const PointsOutline& outline, const StarMesh& mesh, double phase, Shape& shape);

}  // namespace pulvis
