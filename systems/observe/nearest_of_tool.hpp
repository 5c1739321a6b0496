// Distance of a point of an outline from a tool's surface, for observers of contacts on sampled steps.
#pragma once

#include <limits>

#include "components/bundles.hpp"
#include "systems/tools/surface_kernel.hpp"

namespace pulvis {

struct NearestOfTool {
  double distance;  // m, > 0 on the powder side
  Point normal;     // out of the tool
};

inline NearestOfTool nearest_of_tool(const TouchingTools& tools, Row<ToolContact> row,
                                     const Point& at) {
  const auto& [normal, position, shapes] = tools.surfaces;
  const Row<Tool> tool(tools.rows.pair(row, 2));
  const double x = at[0] - position(tool, 0), y = at[1] - position(tool, 1);
  if (!tools.range || !tools.surfaces.is(tool.value, ToolShapes::Kind::polyline)) {
    const Point n{normal(tool, 0), normal(tool, 1)};
    return {x * n[0] + y * n[1], n};
  }
  const auto nearest = kernels::nearest_on_surface((*shapes)->surface_of(tool.value),
                                                   (*tools.range)(row, 0), (*tools.range)(row, 1),
                                                   x, y, std::numeric_limits<double>::infinity());
  return {nearest.distance, {nearest.nx, nearest.ny}};
}

}  // namespace pulvis
