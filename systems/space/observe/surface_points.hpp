// Points of contact on the surfaces of particles and tools, for observers of contacts in sampled steps.
#pragma once

#include <array>
#include <cmath>

#include "engine/entry.hpp"
#include "systems/space/contact/gauss_points.hpp"
#include "systems/space/observe/systems.hpp"
#include "systems/space/tools/tool_gap.hpp"

namespace pulvis::space {

using SurfaceVector = kernels::Vector<double>;

struct PointOnSurface {
  SurfaceVector x;       // m
  SurfaceVector normal;  // outward
  double stretch;        // m^2, area per area of the parameters
};

inline PointOnSurface point_on_surface(const PatchNumbers& face, double u, double v) {
  const auto at = kernels::patch_slopes<double>(face, u, v);
  const SurfaceVector across = cross(at.u, at.v);
  const double stretch = std::sqrt(dot(across, across));
  return {at.x, (1 / stretch) * across, stretch};
}

struct SampledPoint {
  SurfaceVector x;  // m
  double area;      // m^2, current, that belongs to the point
};

// Gauss point g of a face.
inline SampledPoint sampled_point(const PatchNumbers& face, int g) {
  // Gauss-Legendre weights on [0,1], of kernels::gauss_at.
  constexpr std::array<double, 4> weight{0.173927422568726928687, 0.326072577431273071313,
                                         0.326072577431273071313, 0.173927422568726928687};
  const PointOnSurface at =
      point_on_surface(face, entry(kernels::gauss_at, g % 4), entry(kernels::gauss_at, g / 4));
  return {at.x, entry(weight, g % 4) * entry(weight, g / 4) * at.stretch};
}

// Closest point on the other particle, as face_contact has left it.
inline PointOnSurface closest_point(const ShapedBodies<ThreeD>& bodies,
                                    std::span<const double> surface,
                                    const Read<ContactPoint>& points, Row<FaceContact> row, int g,
                                    int other) {
  const double face_u = points(row, ContactPoint::numbers * g + ContactPoint::face_u);
  const int face = static_cast<int>(face_u);
  return point_on_surface(bodies.patch(surface, other, face), face_u - face,
                          points(row, ContactPoint::numbers * g + ContactPoint::v));
}

// Of all points of a row against a tool.
inline std::array<SurfaceGap, 2> gaps_to_tool(const ShapedBodies<ThreeD>& bodies,
                                              std::span<const double> surface,
                                              const TouchingTools& tools,
                                              Row<FaceToolContact> row) {
  const int slot = tools.rows.pair(row, 0), face = tools.rows.pair(row, 1);
  const PatchNumbers points = bodies.patch(surface, slot, face);
  const double size = entry(bodies.shape_of(slot).faces, face).size;
  const auto of = [&](int half) {
    return gap_to_tool(tools.surfaces, tools.triangles, tools.rows.pair(row, 2), row,
                       sampled_points(points, half), size);
  };
  return {of(0), of(1)};
}

inline SurfaceVector normal_of(const std::array<SurfaceGap, 2>& gaps, int g) {
  const VectorLanes& n = entry(gaps, g / lane_count).normal;
  const int lane = g % lane_count;
  return {n.x[lane], n.y[lane], n.z[lane]};
}

}  // namespace pulvis::space
