// Positions of eight points of a face relative to the surface of a nearby tool of any kind.
#pragma once

#include "systems/space/tools/systems.hpp"
#include "systems/space/tools/tool_projection.hpp"

namespace pulvis::space {

// For mesh tools: the triangles that each row can touch.
inline std::span<const std::int32_t> triangles_of(const ToolTriangles& of,
                                                  Row<FaceToolContact> row) {
  const std::span<const std::int32_t> all(of.lists->triangles);
  const std::int32_t first = of.range(row, 0), end = of.range(row, 1);
  return all.subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(end - first));
}

// `size`: m, of the face; points farther from a punch or mesh count as that far away.
inline SurfaceGap gap_to_tool(const ToolSurfaces& tools, const Optional<ToolTriangles>& triangles,
                              int tool, Row<FaceToolContact> row, const VectorLanes& at,
                              double size) {
  const VectorLanes from = at - everywhere(tools.position_of(tool));
  const ToolShapes::Shape& shape = tools.shape(tool);
  const Point normal = tools.normal_of(tool);
  switch (shape.kind) {
    case ToolShapes::Kind::plane:
      return on_plane(normal, from);
    case ToolShapes::Kind::hole:
      return in_hole(shape.radius, normal, from);
    case ToolShapes::Kind::revolution:
      return on_revolution(shape.meridian, normal, from, size);
    case ToolShapes::Kind::constraint:  // has no rows
    case ToolShapes::Kind::mesh:
      break;
  }
  return on_mesh(shape.mesh, triangles_of(*triangles, row), from, size);
}

}  // namespace pulvis::space
