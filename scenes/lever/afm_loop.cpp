#include "scenes/lever/afm_loop.hpp"
#include "engine/portable_math.hpp"
#include "scenes/lever/adhesion.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "scenes/lever/loop_plateau.hpp"
#include "scenes/spec/afm_scene.hpp"

namespace pulvis {

namespace wedge {

double uphill(double load, double adhesion, double mu, double slope) {
  const double s = portable::sin(slope), c = portable::cos(slope);
  return (load * (s + mu * c) + mu * adhesion) / (c - mu * s);
}

double downhill(double load, double adhesion, double mu, double slope) {
  const double s = portable::sin(slope), c = portable::cos(slope);
  return (load * (s - mu * c) - mu * adhesion) / (c + mu * s);
}

std::optional<Roots> friction(double half_width, double offset, double slope,
                              double adhesion_by_load) {
  if (half_width == 0 || slope == 0) return {};
  return roots_of_ratio(offset / half_width, 1, adhesion_by_load, slope);
}

}  // namespace wedge

namespace {

struct Means {
  double force = 0, load = 0, volts = 0, touches = 0;
};

Means means(const AfmHistory& history, const std::string& force, const std::string& volts,
            double from, double until) {
  Means sum;
  int samples = 0;
  for (std::size_t i = 0; i < history.rows.size(); ++i) {
    if (history.times[i] < from || history.times[i] > until) continue;
    sum.force -= history.value(i, force);  // the dragging force is opposite to the holding one
    sum.load += history.value(i, "probe/force_z");
    sum.volts -= history.value(i, volts);
    sum.touches += history.value(i, "contact/points") > 0 ? 1 : 0;
    ++samples;
  }
  const double n = std::max(samples, 1);
  return {sum.force / n, sum.load / n, sum.volts / n, sum.touches / n};
}

// Whether the means were taken on a plateau.
void judge(FrictionLoop& loop, const Plateau& trace, const Plateau& retrace) {
  loop.slides = std::min(trace.slides, retrace.slides);
  loop.turned = std::min(trace.turned, retrace.turned);
  const double maximum = std::max(std::abs(trace.drift), std::abs(retrace.drift));
  loop.drift = maximum == 0 ? 0 : maximum / std::max(maximum, std::abs(loop.half_width));
  if (loop.touches == 1 && (loop.slides <= 1 - 1e-3 || loop.turned <= 1 - 1e-3))
    loop.needed = std::max(trace.needed, retrace.needed);
}

bool on_incline(const TargetSpec& target, const ActionSpec& scan) {
  return target.shape == TargetSpec::Shape::plane && target.incline != 0 &&
         target.direction == scan.direction;
}

// Friction and sensitivity from the volts; of the two roots that whose half-width is the loop's in newtons.
void recover(FrictionLoop& loop, double slope, double adhesion) {
  const auto roots =
      wedge::friction(loop.volts_half_width, loop.volts_offset, slope, adhesion / loop.load);
  if (!roots || wedge::locks(roots->lower, slope)) return;
  const auto width = [&](double mu) { return wedge::half_width(loop.load, adhesion, mu, slope); };
  const double seen = std::abs(loop.half_width);
  loop.friction = roots->lower;
  if (roots->upper && !wedge::locks(*roots->upper, slope)) {
    loop.other_root = *roots->upper;
    if (std::abs(width(*roots->upper) - seen) < std::abs(width(roots->lower) - seen))
      std::swap(*loop.friction, *loop.other_root);
  }
  loop.sensitivity = width(*loop.friction) / loop.volts_half_width;
}

// The root of the first loop, which that loop's forces have chosen.
std::optional<wedge::Calibration> calibrated_like(const FrictionLoop& loop,
                                                  const std::vector<wedge::Loop>& loops,
                                                  double adhesion) {
  const bool is_upper = loop.friction && loop.other_root && *loop.friction > *loop.other_root;
  try {
    return wedge::calibrate_at(loops, {adhesion, 0, 0},
                               is_upper ? wedge::Root::upper : wedge::Root::lower);
  } catch (const std::runtime_error&) {
    return std::nullopt;
  }
}

}  // namespace

std::optional<wedge::Calibration> calibrate_wedge(const Scene& scene,
                                                  const std::vector<FrictionLoop>& loops) {
  std::vector<wedge::Loop> seen;
  const FrictionLoop* first = nullptr;
  for (const FrictionLoop& loop : loops) {
    if (!loop.full() ||
        !on_incline(*scene.afm->target, scene.afm->actions[static_cast<std::size_t>(loop.action)]))
      continue;
    if (first == nullptr) first = &loop;
    seen.push_back(
        {scene.afm->target->incline, loop.load, loop.volts_half_width, loop.volts_offset, {}, {}});
  }
  if (seen.empty()) return std::nullopt;
  return calibrated_like(*first, seen, pull_off_force(scene));
}

double AfmHistory::value(std::size_t sample, const std::string& series) const {
  static const std::vector<SeriesInfo> all = afm_series();
  const auto found = std::ranges::find(all, series, &SeriesInfo::name);
  if (found == all.end()) throw std::logic_error("no series " + series);
  return rows[sample][static_cast<std::size_t>(found - all.begin())];
}

std::vector<FrictionLoop> friction_loops(const Scene& scene, const AfmHistory& history) {
  constexpr double tolerance = 1e-9;
  std::vector<FrictionLoop> loops;
  for (std::size_t a = 0; a < scene.afm->actions.size(); ++a) {
    const ActionSpec& action = scene.afm->actions[a];
    if (action.kind != ActionSpec::Kind::scan || !action.retrace) continue;
    const bool lateral = action.direction == TargetSpec::Direction::lateral;
    const std::string force = lateral ? "probe/force_y" : "probe/force_x";
    const std::string volts = lateral ? "detector/lateral" : "detector/normal";
    const auto start = static_cast<double>(a);
    const Means trace = means(history, force, volts, start + 0.25, start + 0.5 + tolerance);
    const Means retrace = means(history, force, volts, start + 0.75, start + 1 + tolerance);
    // A scan in the negative direction traverses the loop in reverse.
    const double sign = action.distance < 0 ? -1 : 1;
    FrictionLoop loop;
    loop.action = static_cast<int>(a);
    loop.touches = std::min(trace.touches, retrace.touches);
    loop.load = 0.5 * (trace.load + retrace.load);
    loop.trace = trace.force;
    loop.retrace = retrace.force;
    loop.half_width = 0.5 * sign * (trace.force - retrace.force);
    loop.offset = 0.5 * (trace.force + retrace.force);
    loop.volts_half_width = 0.5 * sign * (trace.volts - retrace.volts);
    loop.volts_offset = 0.5 * (trace.volts + retrace.volts);
    judge(loop, plateau_of(scene, history, a, false), plateau_of(scene, history, a, true));
    const TargetSpec& target = *scene.afm->target;
    loop.on_slope = on_incline(target, action);
    if (loop.full() && loop.load > 0 && loop.on_slope)
      recover(loop, target.incline, pull_off_force(scene));
    loops.push_back(loop);
  }
  return loops;
}

}  // namespace pulvis
