// first_penetration, first_time_step, advance_clock: choose the next step; the last one advances the time.
//
// The step is the stable one of every body (stable_time_step), times `safety`. Stability ignores velocities:
// if surfaces would move by more than a share of the thinnest part of an outline or a tool
// (scenes/meshes/thinnest), the step is shortened, so that nothing passes through undetected.
//
// Surfaces that overlap at the start are a sudden load on the stiffest springs. A step near the stability limit would lose up
// to (omega dt)^2/4 of their energy, so the first one is shorter; the following ones grow.
//
// Runs     advance_clock last in a step; first_penetration after the first contact search
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "components/run_state.hpp"
#include "components/servo.hpp"
#include "engine/access.hpp"
#include "engine/portable_math.hpp"
#include "engine/run_failure.hpp"
#include "systems/laws/normal_contact.hpp"
#include "systems/ranks/reduce.hpp"
#include "systems/tools/systems.hpp"

namespace pulvis {
namespace {

// Geometry changes little in a step; where it does, on impact, the stable step is evaluated more often.
constexpr double max_strain_between_looks = 0.01;
// Share of the thinnest part that surfaces may move against each other in a step: what they enter is seen
// while its near side is by far the nearer one, also where speeds grow within the step.
constexpr double max_share_of_thickness = 0.25;
constexpr double overlap_at_start = 1e-5;  // of the size of a face; less is round-off
constexpr double share_at_overlap = 0.2;   // of the stable step, for the first step

double length_of(const Point3& v) { return portable::hypot(portable::hypot(v[0], v[1]), v[2]); }

// Over all tools, from `time` on.
double farthest_displacement(const ToolProgram& program, const Optional<Read<ServoVelocity>>& servo,
                             double time, double dt) {
  double farthest = 0;
  for (int t = 0; t < static_cast<int>(program.names.size()); ++t) {
    const Point3 now = tool_position_at(program, t, time);
    const Point3 next = tool_position_at(program, t, time + dt);
    double displacement = length_of({next[0] - now[0], next[1] - now[1], next[2] - now[2]});
    const Row<Tool> tool(t);
    if (servo)
      displacement += length_of({(*servo)(tool, 0), (*servo)(tool, 1), (*servo)(tool, 2)}) * dt;
    farthest = std::max(farthest, displacement);
  }
  return farthest;
}

// Upper bound on the relative motion of any two surfaces in a step.
template <class D>
class Approach {
 public:
  // `fastest`: m/s, over all outlines.
  Approach(const SurfaceSpeeds<D>& speeds, double fastest) : speeds_(speeds), fastest_(fastest) {
    if (speeds.cell)
      for (const double v : (*speeds.cell)->rate.t) images_ += std::abs(v);
  }
  bool anything() const { return static_cast<bool>(speeds_.outlines); }  // that can touch
  double displacement(double time, double dt) const {
    const double fastest = fastest_ * dt;
    return images_ * dt + fastest +
           std::max(fastest, speeds_.program
                                 ? farthest_displacement(**speeds_.program, speeds_.servo, time, dt)
                                 : 0.0);
  }

 private:
  const SurfaceSpeeds<D>& speeds_;
  double fastest_;
  double images_ = 0;  // m/s, of the nearest images relative to their particles
};

// No surface may be on one side of a part before a step and on, or closer to, its other side afterwards.
template <class D>
double without_passing(const Approach<D>& approach, const Clock& clock, double thinnest,
                       double dt) {
  const double maximum = max_share_of_thickness * thinnest;
  for (double displacement = approach.displacement(clock.time, dt);
       displacement > maximum && std::isfinite(displacement);
       displacement = approach.displacement(clock.time, dt))
    dt *= 0.99 * maximum / displacement;
  return dt;
}

// Over all particles of all ranks.
struct Extremes {
  double min_step = 1e300, fastest = 0;  // s, m/s
};

// `min_jacobian`: of this rank so far; then of all.
template <class D>
Extremes extremes_of(const Bodies& bodies, const Read<StableTimeStep>& stable,
                     const SurfaceSpeeds<D>& speeds, double& min_jacobian, const Link& link) {
  Extremes of;
  bodies.for_own_lanes([&](int slot) {
    of.min_step = std::min(of.min_step, entry(stable.values(), slot));
    if (speeds.outlines) of.fastest = std::max(of.fastest, entry(speeds.outlines->values(), slot));
  });
  if (!link) return of;
  std::array<double, 3> of_all{of.fastest, -of.min_step, -min_jacobian};
  agree(**link, of_all);
  min_jacobian = -of_all[2];
  return {-of_all[1], of_all[0]};
}

template <class D>
void choose_time_step(double min_step, const Approach<D>& approach,
                      const Optional<Read<ContactRules>>& rules, Clock& clock) {
  // Never grow fast: the accelerations caused by a sudden change belong to the old step.
  const double wanted = clock.safety * min_step;
  clock.dt = clock.dt_before > 0 ? std::min(wanted, 1.02 * clock.dt_before) : wanted;
  if (approach.anything())
    clock.dt = without_passing(approach, clock, (*rules)->thinnest, clock.dt);
  // Hit the end of the run exactly, without a tiny last step.
  const double left = clock.end - clock.time;
  if (left > 0 && left < 2 * clock.dt) clock.dt = left > clock.dt ? 0.5 * left : left;
  if (left > 0 && clock.time + clock.dt == clock.time)
    throw RunFailure(fmt::format(
        "advance_clock: step {} at t = {:.6g} s would be {:.3g} s long, too short to be "
        "added to the time (is a tool too fast?)",
        clock.step, clock.time, clock.dt));
}

// Where speeds multiply within a step, the bound for the next one does not help.
void require_in_sight(double displacement, const ContactRules& rules, const Clock& clock) {
  if (displacement <= rules.thinnest || std::isnan(displacement)) return;
  throw RunFailure(fmt::format(
      "advance_clock: surfaces moved up to {:.6g} m against each other in step {}, t = {:.6g} s: "
      "contacts may have been missed; allowed {:.6g} m, the thinnest part of an outline or "
      "a tool (is the load too sudden?)",
      displacement, clock.step, clock.time, rules.thinnest));
}

}  // namespace

void first_penetration::operator()() const {
  double deepest = 0;
  const auto look = [&](const auto& sums) {
    if (sums)
      for (const BlockSums& block : (*sums)->blocks) deepest = std::max(deepest, block.depth);
  };
  look(pairs);
  look(tools);
  clock->stiffening = kernels::stiffening(maximum_of_ranks(link, deepest));
}

template <class D>
void first_time_step<D>::operator()() const {
  double none = 1;
  const Extremes of = extremes_of(*bodies, stable, speeds, none, link);
  choose_time_step(of.min_step, Approach(speeds, of.fastest), rules, *clock);
  if (clock->stiffening > kernels::stiffening(overlap_at_start)) clock->dt *= share_at_overlap;
}

template <class D>
void advance_clock<D>::operator()() const {
  const Extremes of = extremes_of(*bodies, stable, speeds, totals->min_jacobian, link);
  const Approach approach(speeds, of.fastest);
  const bool looked = clock->step >= clock->next_look;
  std::int64_t interval = max_steps_between_looks;
  if (approach.anything()) {
    const double displacement = approach.displacement(clock->time, clock->dt);
    require_in_sight(displacement, **rules, *clock);
    clock->relative_motion += displacement;
    const double strain = displacement / (*rules)->shortest_edge;  // edge lengths per step, at most
    if (looked) {
      interval = std::clamp<std::int64_t>(
          static_cast<std::int64_t>(max_strain_between_looks / std::max(strain, 1e-6)), 1,
          max_steps_between_looks);
    }
    // For the current depth of the surfaces, or the possible depth at the next evaluation.
    clock->stiffening =
        kernels::stiffening(totals->penetration + static_cast<double>(interval) * strain);
  }
  if (ends) clock->end = std::min(clock->end, (*ends)->run_end);
  if (looked) clock->next_look = clock->step + interval;
  clock->time += clock->dt;
  clock->dt_before = clock->dt;
  clock->step += 1;
  choose_time_step(of.min_step, approach, rules, *clock);
}
template struct first_time_step<TwoD>;
template struct first_time_step<ThreeD>;
template struct advance_clock<TwoD>;
template struct advance_clock<ThreeD>;

}  // namespace pulvis
