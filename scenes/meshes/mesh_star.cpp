// An O-grid in any star-shaped curve (about an interior point): ellipse, superellipse, polygon,
// points, fourier.
#include "scenes/meshes/boundary_nodes.hpp"
#include "scenes/meshes/contact_curve.hpp"
#include "scenes/meshes/mesh_outlines.hpp"
#include "scenes/meshes/star_grid.hpp"
#include "scenes/outlines/star.hpp"

namespace pulvis {
namespace {

// Nodes of a sharp outline lie on its straight sides.
std::vector<Point> nodes_on(const BoundaryNodes& boundary) {
  std::vector<Point> nodes;
  for (const OutlinePoint& point : boundary.points) nodes.push_back(point.at);
  return nodes;
}

Point centre_of(const std::vector<Point>& nodes) {
  std::vector<Vec2> polygon;
  for (const Point& p : nodes) polygon.emplace_back(p[0], p[1]);
  const Vec2 centre = star_centre(polygon).value_or(Vec2::Zero());
  return {centre.x(), centre.y()};
}

}  // namespace

void mesh_star(const OutlineCurve& curve, const StarMesh& mesh, Shape& shape) {
  const BoundaryNodes boundary = boundary_nodes(curve, mesh.boundary_edges);
  SmoothOutline outline;
  if (curve.sharp())
    outline.nodes = nodes_on(boundary);
  else
    outline = smooth_outline(boundary.points, shape.area, 0);
  StarGrid grid = star_grid(outline.nodes, centre_of(outline.nodes), mesh.rings);
  shape.nodes = std::move(grid.nodes);
  shape.quads = std::move(grid.quads);
  shape.boundary_nodes = static_cast<int>(outline.nodes.size());
  if (curve.sharp())
    cornered_curve(shape, boundary.corners);
  else
    close_curve(shape, {outline.c, 0});
}

}  // namespace pulvis
