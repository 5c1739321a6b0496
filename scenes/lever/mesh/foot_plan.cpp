#include "scenes/lever/mesh/foot_plan.hpp"

#include <algorithm>
#include <cmath>

#include "scenes/lever/mesh/grading.hpp"

namespace pulvis {
namespace {

using FootShape = TipSpec::Shape;

// Number of elements that the scene requests across a foot.
int wanted_across(const TipSpec& tip) {
  if (tip.shape == FootShape::sphere) return std::max(4, tip.elements / 2);
  return tip.shape == FootShape::mesh ? 4 : tip.elements;
}

// Stresses are singular at the rim of a stiff foot: elements grow fast away from it, in and below the foot.
constexpr double growth_in_foot = 1.2;

// From -1 to 1, symmetric about 0: `edge`, relative to the half-width, at the ends.
std::vector<double> symmetric_lines(double edge, int across, double coarser) {
  const std::vector<double> half =
      graded_lines({1, 2.0 / across, edge, 2.0 / across, growth_in_foot, coarser});
  std::vector<double> lines;
  for (auto line = half.rbegin(); line != half.rend(); ++line) lines.push_back(-*line);
  lines.insert(lines.end(), half.begin() + 1, half.end());
  return lines;
}

PlanMesh square(const std::vector<double>& lines) {
  std::vector<double> shares;
  for (const double line : lines) shares.push_back(0.5 * (1 + line));
  PlanMesh mesh;
  add_patch(mesh, {Vec2(-1, -1), Vec2(1, -1), Vec2(1, 1), Vec2(-1, 1)}, shares, shares, 1e-6);
  return mesh;
}

}  // namespace

Vec2 tip_axis(const LeverSpec& lever, const TipSpec& tip) {
  return {lever.length - tip.set_back, tip.offset};
}

double foot_reach(const TipSpec& tip) {
  if (tip.shape == FootShape::none) return 0;
  if (tip.shape == FootShape::sphere) return tip.neck_radius;
  return 0.5 * tip.foot;
}

std::optional<FootPlan> foot_plan(const LeverSpec& lever, const TipSpec& tip) {
  FootPlan foot;
  foot.axis = tip_axis(lever, tip);
  foot.reach = foot_reach(tip);
  if (foot.reach == 0) return {};
  const int across = wanted_across(tip);
  foot.round = tip.shape == FootShape::cone || tip.shape == FootShape::sphere;
  const double edge = std::min(2.0 / across, 2 * lever.foot_edge);
  foot.edge = edge * foot.reach;
  foot.spacing = foot.round ? 2.0 / across : edge;
  if (foot.round) {
    // Its core is half as wide as the foot, the surrounding ring a quarter of it deep.
    const int core = 2 * std::max(1, static_cast<int>(std::round(0.5 * across / lever.coarser)));
    foot.lines = symmetric_lines(2.0 / core, core, 1);
    foot.unit = unit_disc(
        core, graded_lines({0.5, 1.0 / across, edge, 1.0 / across, growth_in_foot, lever.coarser}));
  } else {
    foot.lines = symmetric_lines(edge, across, lever.coarser);
    if (tip.shape != FootShape::mesh) foot.unit = square(foot.lines);
  }
  return foot;
}

}  // namespace pulvis
