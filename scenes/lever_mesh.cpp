#include "scenes/lever_mesh.hpp"

#include <algorithm>
#include <cmath>

namespace pulvis {
namespace {

// However large the elements may be: as many as the shape of the deformation needs.
constexpr int fewest_along = 20, fewest_across = 4;

std::vector<double> shares_of(std::vector<double> lines) {
  const double whole = lines.back();
  for (double& x : lines) x /= whole;
  return lines;
}

PlanMesh beam_plan(const LeverSpec& lever, double edge, const LeverFoot& foot) {
  const double l = lever.length, w = lever.width;
  const auto lines = [](int count, const std::vector<double>& graded) {
    return count > 0 ? even_shares(count) : shares_of(graded);
  };
  PlanMesh mesh;
  add_patch(mesh, {Vec2(0, -0.5 * w), Vec2(l, -0.5 * w), Vec2(l, 0.5 * w), Vec2(0, 0.5 * w)},
            lines(lever.along, graded_lines(l, edge, foot.size, foot.x, fewest_along)),
            lines(lever.across, graded_lines(w, edge, foot.size, foot.y + 0.5 * w, fewest_across)),
            1e-9 * l);
  return mesh;
}

// Lines of the apex plate, from the inner corner to the end: as far apart as its width shrinks, so that
// elements keep their shape towards a point, and finer at the foot.
std::vector<double> apex_lines(const VOutline& v, double end, double edge, const LeverFoot& foot) {
  const double length = end - v.inner;
  const double slope = std::tan(v.half_angle);
  std::vector<double> lines{0};
  while (lines.back() < length) {
    const double x = v.inner + lines.back();
    const double size =
        std::min({edge, 0.3 * (v.apex - x) * slope, foot.size + 0.4 * std::abs(x - foot.x)});
    lines.push_back(lines.back() + size);
  }
  for (double& x : lines) x *= length / lines.back();
  return lines;
}

PlanMesh v_plan(const LeverSpec& lever, double edge, const LeverFoot& foot) {
  const VOutline v = v_outline(lever);
  const double slope = std::tan(v.half_angle), tolerance = 1e-9 * lever.length;
  // A pointed lever is cut off where it is a fiftieth of an arm wide: nothing beyond carries load.
  const double end = std::min(lever.length, v.apex - 0.01 * lever.arm_width / slope);
  const Vec2 inner(v.inner, 0), outer(v.inner, (v.apex - v.inner) * slope);
  const double width = std::max((v.apex - std::min(foot.x, end)) * slope, foot.size);
  const auto across =
      shares_of(graded_lines(1, edge / lever.arm_width, foot.size / width, 0, fewest_across));
  const double arm = v.inner / std::cos(v.half_angle);
  PlanMesh half;
  add_patch(half, {Vec2(0, v.inner * slope), inner, outer, Vec2(0, v.apex * slope)},
            shares_of(graded_lines(arm, edge, lever.arm_width / 8, arm, fewest_along)), across,
            tolerance);
  add_patch(half, {inner, Vec2(end, 0), Vec2(end, (v.apex - end) * slope), outer},
            shares_of(apex_lines(v, end, edge, foot)), across, tolerance);
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

PlanMesh lever_plan(const LeverSpec& lever, const LeverFoot& foot) {
  // More elements than that along a thin lever cost time and hardly add accuracy.
  constexpr double most_along = 150;
  const double edge = std::max(lever.aspect * lever.thickness, lever.length / most_along);
  return lever.shape == LeverSpec::Shape::beam ? beam_plan(lever, edge, foot)
                                               : v_plan(lever, edge, foot);
}

LeverMesh add_lever(SolidDraft& draft, const LeverSpec& lever, PlanMesh plan) {
  LeverMesh mesh{std::move(plan), {}};
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
      draft.add_hexahedron(corners, coat ? SolidPart::coating : SolidPart::lever, lever.element);
    }
  return mesh;
}

}  // namespace pulvis
