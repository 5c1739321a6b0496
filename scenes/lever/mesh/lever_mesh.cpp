#include "scenes/lever/mesh/lever_mesh.hpp"

#include <algorithm>
#include <cmath>

#include "engine/portable_math.hpp"
#include "scenes/lever/mesh/meshed_lever.hpp"

namespace pulvis {
namespace {

// However large the elements may be: as many as the shape of the deformation needs.
constexpr int fewest_along = 20, fewest_across = 4;

std::vector<double> shares_of(std::vector<double> lines) {
  const double whole = lines.back();
  for (double& x : lines) x /= whole;
  return lines;
}

// Shares of the length and of the width where its lines run.
struct BeamLines {
  std::vector<double> along, across;
};
BeamLines beam_lines(const LeverSpec& lever, double edge, const LeverFoot& foot) {
  const double l = lever.length, w = lever.width;
  const auto lines = [](int count, const std::vector<double>& graded) {
    return count > 0 ? even_shares(count) : shares_of(graded);
  };
  return {lines(lever.along, graded_lines(l, edge, foot.size, foot.x, fewest_along)),
          lines(lever.across, graded_lines(w, edge, foot.size, foot.y + 0.5 * w, fewest_across))};
}

PlanMesh beam_plan(const LeverSpec& lever, double edge, const LeverFoot& foot) {
  const double l = lever.length, w = lever.width;
  const BeamLines lines = beam_lines(lever, edge, foot);
  PlanMesh mesh;
  add_patch(mesh, {Vec2(0, -0.5 * w), Vec2(l, -0.5 * w), Vec2(l, 0.5 * w), Vec2(0, 0.5 * w)},
            lines.along, lines.across, 1e-9 * l);
  return mesh;
}

// Lines of the apex plate, from the inner corner to the end: as far apart as its width shrinks, so that
// elements keep their shape towards a point, and finer at the foot.
std::vector<double> apex_lines(const VOutline& v, double end, double edge, const LeverFoot& foot) {
  const double length = end - v.inner;
  const double slope = portable::tan(v.half_angle);
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

// A pointed lever is cut off where it is a fiftieth of an arm wide: nothing beyond carries load.
double v_end(const LeverSpec& lever, const VOutline& v) {
  return std::min(lever.length, v.apex - 0.01 * lever.arm_width / portable::tan(v.half_angle));
}

// Shares where the lines of its half run: along the arm, along the apex plate, and across both.
struct VLines {
  std::vector<double> arm, apex, across;
};
VLines v_lines(const LeverSpec& lever, double edge, const LeverFoot& foot) {
  const VOutline v = v_outline(lever);
  const double end = v_end(lever, v), arm = v.inner / portable::cos(v.half_angle);
  const double width =
      std::max((v.apex - std::min(foot.x, end)) * portable::tan(v.half_angle), foot.size);
  return {shares_of(graded_lines(arm, edge, lever.arm_width / 8, arm, fewest_along)),
          shares_of(apex_lines(v, end, edge, foot)),
          shares_of(graded_lines(1, edge / lever.arm_width, foot.size / width, 0, fewest_across))};
}

PlanMesh v_plan(const LeverSpec& lever, double edge, const LeverFoot& foot) {
  const VOutline v = v_outline(lever);
  const double slope = portable::tan(v.half_angle), tolerance = 1e-9 * lever.length;
  const double end = v_end(lever, v);
  const Vec2 inner(v.inner, 0), outer(v.inner, (v.apex - v.inner) * slope);
  const VLines lines = v_lines(lever, edge, foot);
  PlanMesh half;
  add_patch(half, {Vec2(0, v.inner * slope), inner, outer, Vec2(0, v.apex * slope)}, lines.arm,
            lines.across, tolerance);
  add_patch(half, {inner, Vec2(end, 0), Vec2(end, (v.apex - end) * slope), outer}, lines.apex,
            lines.across, tolerance);
  return with_mirror_image(half, tolerance);
}

// More elements than that along a thin lever cost time and hardly add accuracy.
constexpr double max_along = 150;
double edge_of(const LeverSpec& lever) {
  return std::max(lever.aspect * lever.thickness, lever.length / max_along);
}

}  // namespace

VOutline v_outline(const LeverSpec& lever) {
  VOutline v;
  if (lever.half_angle)
    v.half_angle = *lever.half_angle;
  else
    v.half_angle = portable::atan(0.5 * (*lever.base_width - lever.apex_width) / lever.length);
  v.apex = lever.length + 0.5 * lever.apex_width / portable::tan(v.half_angle);
  v.inner = v.apex - lever.arm_width / portable::sin(v.half_angle);
  v.base_width = 2 * v.apex * portable::tan(v.half_angle);
  return v;
}

PlanMesh lever_plan(const LeverSpec& lever, const LeverFoot& foot) {
  if (lever.shape == LeverSpec::Shape::mesh) return lever.solid->face.plan;
  const double edge = edge_of(lever);
  return lever.shape == LeverSpec::Shape::beam ? beam_plan(lever, edge, foot)
                                               : v_plan(lever, edge, foot);
}

PlanCount plan_count(const LeverSpec& lever, const LeverFoot& foot) {
  const auto between = [](const std::vector<double>& lines) {
    return static_cast<std::int64_t>(lines.size()) - 1;
  };
  if (lever.shape == LeverSpec::Shape::beam) {
    const BeamLines lines = beam_lines(lever, edge_of(lever), foot);
    return {between(lines.along), between(lines.across)};
  }
  const VLines lines = v_lines(lever, edge_of(lever), foot);
  return {between(lines.arm) + between(lines.apex), 2 * between(lines.across)};
}

std::optional<LeverMesh::Point> LeverMesh::on(std::size_t level, const Vec2& point) const {
  const LeverLevel& at = levels[level];
  const auto place = locate(*at.plan, point);
  if (!place) return {};
  Point found;
  for (const auto& [p, weight] : *place) {
    found.gauge.push_back({at.node[static_cast<std::size_t>(p)], weight});
    found.z += weight * at.z[static_cast<std::size_t>(p)];
  }
  return found;
}

std::optional<LeverMesh::Point> LeverMesh::on_middle(const Vec2& point) const {
  std::optional<Point> below = on(0, point), above = on(1, point);
  for (std::size_t level = 2; above && above->z < 0 && level < levels.size(); ++level) {
    below = std::move(above);
    above = on(level, point);
  }
  if (!below || !above) return {};
  const double s = -below->z / (above->z - below->z);
  Point middle;
  for (const auto& [node, weight] : below->gauge) middle.gauge.push_back({node, (1 - s) * weight});
  for (const auto& [node, weight] : above->gauge) middle.gauge.push_back({node, s * weight});
  return middle;
}

LeverMesh add_lever(SolidDraft& draft, const LeverSpec& lever, const PlanMesh& plan) {
  LeverMesh mesh;
  const auto shared = std::make_shared<const PlanMesh>(plan);
  const double t = lever.thickness;
  std::vector<double> levels;
  for (int i = 0; i <= lever.layers; ++i) levels.push_back(t * i / lever.layers - 0.5 * t);
  if (lever.coating) levels.push_back(0.5 * t + lever.coating_thickness);
  for (const double z : levels) {
    LeverLevel level{shared, {}, std::vector<double>(plan.points.size(), z)};
    for (const Vec2& p : plan.points) {
      level.node.push_back(draft.add_node({p.x(), p.y(), z}));
      draft.held[static_cast<std::size_t>(level.node.back())] =
          std::abs(p.x()) < 1e-9 * lever.length ? 1 : 0;
    }
    mesh.levels.push_back(std::move(level));
  }
  for (std::size_t level = 0; level + 1 < levels.size(); ++level)
    for (const auto& q : plan.quads) {
      SolidMesh::Hexahedron corners;
      for (std::size_t c = 0; c < 4; ++c) {
        corners[c] = mesh.levels[level].node[static_cast<std::size_t>(q[c])];
        corners[c + 4] = mesh.levels[level + 1].node[static_cast<std::size_t>(q[c])];
      }
      const bool coat = level >= static_cast<std::size_t>(lever.layers);
      draft.add_hexahedron(corners, coat ? SolidPart::coating : SolidPart::lever, lever.element);
    }
  return mesh;
}

}  // namespace pulvis
