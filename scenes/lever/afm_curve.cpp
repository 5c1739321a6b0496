#include "scenes/lever/afm_curve.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenes/spec/afm_scene.hpp"

namespace pulvis {
namespace {

using Kind = ActionSpec::Kind;

// Retracting actions [begin, end) after a press, with holds between them.
struct Withdrawal {
  std::size_t begin = 0, end = 0;
};

std::vector<Withdrawal> withdrawals(const std::vector<ActionSpec>& actions) {
  std::vector<Withdrawal> all;
  bool pressed = false;
  for (std::size_t a = 0; a < actions.size(); ++a) {
    if (actions[a].kind == Kind::press) pressed = true;
    if (actions[a].kind == Kind::scan || actions[a].kind == Kind::raster) pressed = false;
    if (actions[a].kind != Kind::retract || !pressed) continue;
    std::size_t end = a;
    while (end < actions.size() &&
           (actions[end].kind == Kind::retract || actions[end].kind == Kind::hold))
      ++end;
    all.push_back({a, end});
    a = end - 1;
    pressed = false;
  }
  return all;
}

std::optional<double> work_of_adhesion(const AfmScene& afm, double pull_off) {
  const double radius = std::max(afm.tip.radius, afm.tip.end_radius);
  if (!(radius > 0)) return std::nullopt;
  const bool jkr = afm.target->adhesion == TargetSpec::Adhesion::jkr;
  return pull_off / ((jkr ? 1.5 : 2.0) * std::numbers::pi * radius);
}

}  // namespace

double pulling_area(double from, double to, double way) {
  if (from >= 0 && to >= 0) return 0;
  if (from <= 0 && to <= 0) return -(from + to) / 2 * way;
  const double below = std::min(from, to), share = below / (below - std::max(from, to));
  return -below / 2 * share * way;
}

bool has_force_curve(const Scene& scene) {
  return scene.afm && scene.afm->target && !withdrawals(scene.afm->actions).empty();
}

std::vector<ForceCurveFigures> force_curves(const Scene& scene, const AfmHistory& history) {
  std::vector<ForceCurveFigures> all;
  if (!has_force_curve(scene)) return all;
  const AfmScene& afm = *scene.afm;
  for (const Withdrawal& away : withdrawals(afm.actions)) {
    std::size_t row = 0;  // the first row is the state before the programme
    for (std::size_t a = 0; a < away.begin; ++a) row += afm.actions[a].samples();
    std::size_t last = row;
    for (std::size_t a = away.begin; a < away.end; ++a) last += afm.actions[a].samples();
    if (last >= history.rows.size()) break;
    ForceCurveFigures curve;
    curve.action = static_cast<int>(away.begin);
    curve.released = history.value(last, "contact/points") == 0;
    curve.greatest = history.value(row, "probe/force_z");
    for (std::size_t i = row + 1; i <= last; ++i)
      curve.pull_off = std::max(curve.pull_off, -history.value(i, "probe/lowest_force_z"));
    curve.work = history.value(last, "energy/pulling") - history.value(row, "energy/pulling");
    curve.work_of_adhesion = work_of_adhesion(afm, curve.pull_off);
    all.push_back(curve);
  }
  return all;
}

}  // namespace pulvis
