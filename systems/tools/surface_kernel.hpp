// Signed distance to a chain of straight pieces and arcs: d > 0 in the powder, d < 0 in the tool.
//
// Law      |d| is the distance to the nearest point of the surface, the normal points along grad d. Every
//          point of the plane has its nearest surface point on a straight part between its ends, or in
//          the wedge of a corner; each piece applies only there, and the nearest one wins. So a
//          corner of the tool pushes radially, and behind both flanks of a valley the way out leads to
//          its bottom. Potentials of d are continuous; so is their force, except deep inside a sharp
//          corner of the tool, where the nearer flank changes.
// Symbols  t along the chain, n = (-t_y, t_x) into the powder, s = (x - a) . t
// Range    chains that do not cross themselves; straight parts extend a round-off beyond their ends, so
//          that no point falls between a straight part and its arc
#pragma once

#include <limits>

#include "components/surface.hpp"
#include "engine/entry.hpp"
#include "engine/lane.hpp"

namespace pulvis::kernels {

template <class T>
struct SurfacePoint {
  T distance;  // m, signed
  T nx, ny;    // outward from the tool
};

template <class T>
void keep_nearer(SurfacePoint<T>& nearest, T there, T distance, T nx, T ny) {
  const auto nearer = there < abs(nearest.distance);
  nearest.distance = select(nearer, distance, nearest.distance);
  nearest.nx = select(nearer, nx, nearest.nx);
  nearest.ny = select(nearer, ny, nearest.ny);
}

template <class T>
void look_at_straight(const ToolSurface::Piece& p, T x, T y, SurfacePoint<T>& nearest) {
  const T dx = x - p.x, dy = y - p.y, far = T{} + std::numeric_limits<double>::infinity();
  const T s = dx * p.tx + dy * p.ty;
  const T distance = dy * p.tx - dx * p.ty;
  const T there = select(s < p.low, far, select(s > p.high, far, abs(distance)));
  keep_nearer(nearest, there, distance, T{} - p.ty, T{} + p.tx);
}

template <class T>
void look_at_corner(const ToolSurface::Piece& p, T x, T y, SurfacePoint<T>& nearest) {
  if (p.side == 0) return;
  const T rx = x - p.corner_x, ry = y - p.corner_y;
  const T far = T{} + std::numeric_limits<double>::infinity();
  const T length = sqrt(rx * rx + ry * ry);
  const T distance = p.side * length - p.radius;
  const T after = rx * p.next_tx + ry * p.next_ty;  // > 0: belongs to the next piece
  const T there = select(rx * p.tx + ry * p.ty < 0.0, far, select(after > 0.0, far, abs(distance)));
  const T scale = p.side / max(length, T{} + std::numeric_limits<double>::min());
  const auto apart = length > 0.0;  // at the exact centre any direction will do
  keep_nearer(nearest, there, distance, select(apart, rx * scale, T{} - p.ty),
              select(apart, ry * scale, T{} + p.tx));
}

// The nearest point of pieces [first, last] that is closer than `cutoff`; otherwise distance = cutoff.
template <class T>
SurfacePoint<T> nearest_on_surface(const ToolSurface& surface, int first, int last, T x, T y,
                                   double cutoff) {
  SurfacePoint<T> nearest{T{} + cutoff, T{}, T{}};
  for (int i = first; i <= last; ++i) {
    const ToolSurface::Piece& piece = entry(surface.pieces, i);
    look_at_straight(piece, x, y, nearest);
    look_at_corner(piece, x, y, nearest);
  }
  return nearest;
}

}  // namespace pulvis::kernels
