#include "scenes/lever_mesh.hpp"

#include <algorithm>
#include <cmath>

namespace pulvis {
namespace {

// However large the elements may be: as many as the shape of the deformation needs.
constexpr int fewest_along = 20, fewest_across = 4;

int count(double length, double edge, int fewest) {
  return std::max(fewest, static_cast<int>(std::ceil(length / edge * (1 - 1e-9))));
}
int even(int n) { return n + n % 2; }

PlanMesh beam_plan(const LeverSpec& lever, double edge) {
  const double l = lever.length, half = 0.5 * lever.width;
  PlanMesh mesh;
  add_patch(mesh, {Vec2(0, -half), Vec2(l, -half), Vec2(l, half), Vec2(0, half)},
            count(l, edge, fewest_along), even(count(lever.width, edge, fewest_across)), 1e-9 * l);
  return mesh;
}

// The triangle of a pointed V in three patches that meet in its middle.
void add_triangle(PlanMesh& mesh, const Vec2& inner, const Vec2& apex, const Vec2& outer, int half,
                  double tolerance) {
  const Vec2 middle = (inner + apex + outer) / 3;
  const Vec2 ia = 0.5 * (inner + apex), ao = 0.5 * (apex + outer), oi = 0.5 * (outer + inner);
  add_patch(mesh, {inner, ia, middle, oi}, half, half, tolerance);
  add_patch(mesh, {ia, apex, ao, middle}, half, half, tolerance);
  add_patch(mesh, {middle, ao, outer, oi}, half, half, tolerance);
}

PlanMesh v_plan(const LeverSpec& lever, double edge) {
  const VOutline v = v_outline(lever);
  const double slope = std::tan(v.half_angle), tolerance = 1e-9 * lever.length;
  const Vec2 inner(v.inner, 0), outer(v.inner, (v.apex - v.inner) * slope);
  const int across = even(count(lever.arm_width, edge, fewest_across));
  PlanMesh half;
  add_patch(half, {Vec2(0, v.inner * slope), inner, outer, Vec2(0, v.apex * slope)},
            count(v.inner / std::cos(v.half_angle), edge, fewest_along), across, tolerance);
  if (lever.apex_width > 0)
    add_patch(half, {inner, Vec2(lever.length, 0), Vec2(lever.length, 0.5 * lever.apex_width), outer},
              count(lever.length - v.inner, edge, fewest_across), across, tolerance);
  else
    add_triangle(half, inner, Vec2(lever.length, 0), outer, across / 2, tolerance);
  return with_mirror_image(half, tolerance);
}

}  // namespace

VOutline v_outline(const LeverSpec& lever) {
  VOutline v;
  if (lever.half_angle)
    v.half_angle = *lever.half_angle;
  else
    v.half_angle = std::atan(0.5 * (*lever.base_width - lever.apex_width) / lever.length);
  v.apex = lever.length + 0.5 * lever.apex_width / std::tan(v.half_angle);
  v.inner = v.apex - lever.arm_width / std::sin(v.half_angle);
  v.base_width = 2 * v.apex * std::tan(v.half_angle);
  return v;
}

PlanMesh lever_plan(const LeverSpec& lever) {
  const double edge = lever.aspect * lever.thickness;
  return lever.shape == LeverSpec::Shape::beam ? beam_plan(lever, edge) : v_plan(lever, edge);
}

LeverMesh add_lever(SolidDraft& draft, const LeverSpec& lever) {
  LeverMesh mesh{lever_plan(lever), {}};
  const double t = lever.thickness;
  for (int i = 0; i <= lever.layers; ++i) mesh.levels.push_back(t * i / lever.layers - 0.5 * t);
  if (lever.coating) mesh.levels.push_back(0.5 * t + lever.coating_thickness);
  for (const double z : mesh.levels)
    for (const Vec2& p : mesh.plan.points) {
      const int node = draft.add_node({p.x(), p.y(), z});
      draft.held[static_cast<std::size_t>(node)] = std::abs(p.x()) < 1e-9 * lever.length ? 1 : 0;
    }
  for (std::size_t level = 0; level + 1 < mesh.levels.size(); ++level)
    for (const auto& q : mesh.plan.quads) {
      SolidMesh::Hexahedron corners;
      for (std::size_t c = 0; c < 4; ++c) {
        corners[c] = mesh.node(q[c], level);
        corners[c + 4] = mesh.node(q[c], level + 1);
      }
      const bool coat = level >= static_cast<std::size_t>(lever.layers);
      draft.add_hexahedron(corners, coat ? SolidPart::coating : SolidPart::lever, true);
    }
  return mesh;
}

}  // namespace pulvis
