// Projection on tools: positions of eight points relative to planes, round holes, bodies of revolution and meshes.
//
// Source   systems/tools/surface_kernel.hpp (meridians), triangle_kernel.hpp
#pragma once

#include <span>

#include "components/space/tools.hpp"
#include "systems/space/contact/projection.hpp"
#include "systems/space/tools/triangle_kernel.hpp"
#include "systems/tools/surface_kernel.hpp"

namespace pulvis::space {

inline VectorLanes everywhere(const Point& p) { return kernels::everywhere<Lane>(p); }

// `from`: vector from the tool's position to the points, also below.
inline SurfaceGap on_plane(const Point& normal, const VectorLanes& from) {
  SurfaceGap s;
  s.normal = everywhere(normal);
  s.gap = -dot(from, s.normal);
  return s;
}

struct RadiusAndHeight {
  Lane height, radius;
  VectorLanes outward;  // away from the axis; zero on it
  RadiusAndHeight(const VectorLanes& from, const VectorLanes& axis) {
    height = dot(from, axis);
    const VectorLanes arm = fma(-height, axis, from);
    radius = sqrt(dot(arm, arm));
    outward = select(radius > 0.0, 1.0 / radius, Lane{}) * arm;
  }
};

inline SurfaceGap in_hole(double radius, const Point& axis, const VectorLanes& from) {
  const RadiusAndHeight at(from, everywhere(axis));
  SurfaceGap s;
  s.normal = -at.outward;
  s.gap = at.radius - radius;
  return s;
}

inline SurfaceGap on_revolution(const ToolSurface& meridian, const Point& axis,
                                const VectorLanes& from, double farthest) {
  const VectorLanes along = everywhere(axis);
  const RadiusAndHeight at(from, along);
  const auto nearest = pulvis::kernels::nearest_on_surface(
      meridian, 0, static_cast<int>(meridian.pieces.size()) - 1, at.radius, at.height, farthest);
  SurfaceGap s;
  s.normal = fma(nearest.nx, at.outward, nearest.ny * along);
  s.gap = -nearest.distance;
  return s;
}

// Only the given triangles; points farther than `farthest` are treated as that far outside.
inline SurfaceGap on_mesh(const TriangleMesh& mesh, std::span<const std::int32_t> triangles,
                          const VectorLanes& from, double farthest) {
  kernels::NearestOfMesh<Lane> nearest{Lane(farthest * farthest), everywhere({}), everywhere({})};
  for (const std::int32_t t : triangles)
    kernels::look_at_triangle(entry(mesh.triangles, t), from, nearest);
  const Lane side = select(dot(nearest.offset, nearest.outward) < 0.0, Lane(-1.0), Lane(1.0));
  const Lane distance = sqrt(nearest.square);
  SurfaceGap s;
  s.gap = -(side * distance);
  // On the surface itself, up to round-off, the normal of the surface is used.
  constexpr double round_off = 1e-12;
  const LaneMask apart = distance > Lane(round_off * farthest);
  s.normal = select(apart, (side / distance) * nearest.offset, nearest.outward);
  return s;
}

}  // namespace pulvis::space
