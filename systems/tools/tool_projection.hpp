// Projection on tools: positions of the Gauss points of two candidates relative to planes and polylines.
//
// Source   systems/tools/surface_kernel.hpp
#pragma once

#include "systems/contact/two_candidates.hpp"
#include "systems/tools/surface_kernel.hpp"
#include "systems/tools/systems.hpp"

namespace pulvis {

// On a plane through `point`.
inline PointMotion project_on_plane(const Point& point, const Point& normal, const PointLanes& at) {
  const Lane rx = at.x - point[0], ry = at.y - point[1];
  PointMotion m;
  m.nx = normal[0];
  m.ny = normal[1];
  m.gap = -(rx * m.nx + ry * m.ny);
  return m;
}

// On the pieces of a polyline with its origin at `point`; points farther than `farthest` get that distance and no
// normal.
inline PointMotion project_on_polyline(const Point& point, const ToolSurface& surface, int first,
                                       int last, const PointLanes& at, double farthest) {
  const auto nearest =
      kernels::nearest_on_surface(surface, first, last, at.x - point[0], at.y - point[1], farthest);
  PointMotion m;
  m.nx = nearest.nx;
  m.ny = nearest.ny;
  m.gap = -nearest.distance;
  return m;
}

// The points of one from `a`, those of the other from `b`.
inline PointMotion halves_of(const PointMotion& a, const PointMotion& b) {
  const LaneMask low = LaneMask::of(lanes_of_halves[1]);
  PointMotion m;
  m.nx = select(low, a.nx, b.nx);
  m.ny = select(low, a.ny, b.ny);
  m.gap = select(low, a.gap, b.gap);
  return m;
}

// Velocities of the points relative to tools that do not rotate.
inline void set_rates(const PointLanes& velocity, const Lane& tool_x, const Lane& tool_y,
                      PointMotion& m) {
  const Lane wx = velocity.x - tool_x, wy = velocity.y - tool_y;
  m.gap_rate = -(wx * m.nx + wy * m.ny);
  m.slip_rate = wy * m.nx - wx * m.ny;
}

}  // namespace pulvis
