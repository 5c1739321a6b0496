// Rectangle: a plain grid.
#include "scenes/meshes/contact_curve.hpp"
#include "scenes/meshes/mesh_outlines.hpp"
#include "scenes/meshes/o_grid.hpp"

namespace pulvis {

void mesh_outline(const RectangleOutline& rectangle, const RectangleMesh& mesh, double /*phase*/,
                  Shape& shape) {
  const OGrid grid{mesh.columns, mesh.rows, 0};
  shape.nodes.resize(static_cast<std::size_t>(grid.nodes()));
  for (int row = 0; row <= mesh.rows; ++row)
    for (int column = 0; column <= mesh.columns; ++column)
      shape.nodes[static_cast<std::size_t>(grid.core(column, row))] = {
          rectangle.width * (double(column) / mesh.columns - 0.5),
          rectangle.height * (double(row) / mesh.rows - 0.5)};
  shape.quads = quads_of(grid);
  shape.boundary_nodes = grid.around();
  cornered_curve(shape, {0, mesh.columns, mesh.columns + mesh.rows, 2 * mesh.columns + mesh.rows});
}

}  // namespace pulvis
