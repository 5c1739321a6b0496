// Ring: layers between the disc's outline and the hole, whose polygon has the hole's area just as the outer
// one has the disc's.
#include <numbers>

#include "scenes/meshes/contact_curve.hpp"
#include "scenes/meshes/mesh_outlines.hpp"
#include "scenes/meshes/mesh_round.hpp"
#include "scenes/meshes/o_grid.hpp"
#include "scenes/meshes/smooth_outline.hpp"

namespace pulvis {

void mesh_outline(const RingOutline& ring, const RingMesh& mesh, double phase, Shape& shape) {
  const std::vector<double> side =
      stations_of(std::vector<double>(static_cast<std::size_t>(mesh.boundary_edges / 4), 1.0));
  const double disc = std::numbers::pi / 4 * ring.diameter * ring.diameter;
  const SmoothOutline outline =
      smooth_outline(rounded_points({ring.diameter, ring.diameter}, ring.diameter / 2, side, side),
                     disc, short_wave_filter);
  const int around = mesh.boundary_edges;
  const double hole = ring.hole / ring.diameter;
  for (int layer = 0; layer <= mesh.rings; ++layer)
    for (const Point& p : outline.nodes) {
      const double share = 1 - (1 - hole) * layer / mesh.rings;
      shape.nodes.push_back(turned({share * p[0], share * p[1]}, phase));
    }
  const auto node = [&](int layer, int i) { return Row<Node>(layer * around + i % around); };
  for (int layer = 0; layer < mesh.rings; ++layer)
    for (int i = 0; i < around; ++i)
      shape.quads.push_back(
          {node(layer, i), node(layer, i + 1), node(layer + 1, i + 1), node(layer + 1, i)});
  shape.boundary_nodes = around;
  close_curve(shape, {outline.c, short_wave_filter});
}

}  // namespace pulvis
