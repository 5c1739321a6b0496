#include "scenes/checks/surface_overlap.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "scenes/spec/rotation.hpp"
#include "systems/tools/surface_kernel.hpp"

namespace pulvis {
namespace {

constexpr double nothing = -std::numeric_limits<double>::infinity();

// Of a point from a rectangle about the origin: < 0 inside.
double distance_to_rectangle(const Vec2& at, const Vec2& half) {
  const Vec2 beyond = at.cwiseAbs() - half;
  return beyond.maxCoeff() <= 0 ? beyond.maxCoeff() : beyond.cwiseMax(0).norm();
}

// Depth in the rectangle of the midpoint of that part of a straight piece that lies inside it. a, t: in the
// rectangle's frame.
double piercing_depth(const Vec2& a, const Vec2& t, double low, double high, const Vec2& half) {
  for (int k = 0; k < 2; ++k) {
    if (t[k] == 0) {
      if (std::abs(a[k]) >= half[k]) return nothing;
      continue;
    }
    const double one = (-half[k] - a[k]) / t[k], other = (half[k] - a[k]) / t[k];
    low = std::max(low, std::min(one, other));
    high = std::min(high, std::max(one, other));
  }
  return low < high ? -distance_to_rectangle(a + 0.5 * (low + high) * t, half) : nothing;
}

// Of a point from a simple polygon: < 0 inside.
double distance_to_polygon(const Vec2& at, const std::vector<Vec2>& polygon) {
  double minimum = std::numeric_limits<double>::max();
  bool inside = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 a = polygon[i], b = polygon[(i + 1) % polygon.size()], along = b - a;
    const double share = std::clamp((at - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
    minimum = std::min(minimum, (a + share * along - at).norm());
    if ((a.y() > at.y()) != (b.y() > at.y()) &&
        at.x() < a.x() + (at.y() - a.y()) / along.y() * along.x())
      inside = !inside;
  }
  return inside ? -minimum : minimum;
}

}  // namespace

double signed_distance(const ToolSurface& surface, const Vec2& at) {
  return kernels::nearest_on_surface(surface, 0, static_cast<int>(surface.pieces.size()) - 1,
                                     at.x(), at.y(), std::numeric_limits<double>::infinity())
      .distance;
}

// Maximum depth of the box's corners in the tool, the tool's corners in the box, and straight pieces that pass
// through it; if apart, minus the distance. A rounded box is its box expanded by its radius.
double depth_in_tool(const ToolSurface& surface, const Vec2& centre, double angle,
                     const RoundedBox& outline) {
  const Vec2& half = outline.half;
  const Eigen::Matrix2d turn = rotation(angle);
  double depth = nothing;
  for (const Vec2& corner : {Vec2(-1, -1), Vec2(1, -1), Vec2(1, 1), Vec2(-1, 1)})
    depth = std::max(depth, -signed_distance(surface, centre + turn * corner.cwiseProduct(half)));
  for (const ToolSurface::Piece& p : surface.pieces) {
    const Vec2 from = turn.transpose() * (Vec2(p.x, p.y) - centre);
    const Vec2 t = turn.transpose() * Vec2(p.tx, p.ty);
    depth = std::max(depth, piercing_depth(from, t, p.low, p.high, half));
    if (p.side <= 0) continue;
    const Vec2 corner = turn.transpose() * (Vec2(p.corner_x, p.corner_y) - centre);
    depth = std::max(depth, p.radius - distance_to_rectangle(corner, half));
  }
  return outline.radius + depth;
}

// The same for a polygon with short sides: a piece that passes through it leaves some of its corners behind.
double depth_in_tool(const ToolSurface& surface, const Vec2& centre, double angle,
                     const std::vector<Vec2>& polygon) {
  const Eigen::Matrix2d turn = rotation(angle);
  double depth = nothing;
  for (const Vec2& corner : polygon)
    depth = std::max(depth, -signed_distance(surface, centre + turn * corner));
  for (const ToolSurface::Piece& p : surface.pieces) {
    if (p.side <= 0) continue;
    const Vec2 corner = turn.transpose() * (Vec2(p.corner_x, p.corner_y) - centre);
    depth = std::max(depth, p.radius - distance_to_polygon(corner, polygon));
  }
  return depth;
}

}  // namespace pulvis
