#include "systems/cell/mixed_control.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/entry.hpp"
#include "engine/run_failure.hpp"
#include "systems/tools/tool_kernel.hpp"

namespace pulvis {
namespace {

using Stage = MixedControl::Stage;
using Law = MixedControl::Law;
constexpr std::array<const char*, MixedControl::parts> names{"xx", "yy", "zz", "xy", "yz", "zx"};

// Pa: the stress to reach at the end of the stage.
double aim(const MixedControl& control, const Stage& stage, int part) {
  const double axial = control.stress[control.axial()], given = entry(stage.stress, part);
  switch (entry(stage.law, part)) {
    case Law::ratio:
      return given * axial;
    case Law::mean:
      return (control.axes * given - axial) / (control.axes - 1);
    default:
      return given;
  }
}

// Pa: to which errors of the stage's stresses are relative.
double largest_target(const MixedControl& control, const Stage& stage) {
  double largest = 0;
  for (int k = 0; k < MixedControl::parts; ++k)
    if (entry(stage.law, k) != Law::strain)
      largest =
          std::max({largest, std::abs(aim(control, stage, k)), std::abs(entry(stage.stress, k))});
  return largest;
}

void check_held(const Stage& stage, const std::string& name, const MixedControl& control,
                const Clock& clock) {
  const double allowed = stage.tolerance * largest_target(control, stage);
  for (int k = 0; k < MixedControl::parts; ++k) {
    if (entry(stage.law, k) == Law::strain) continue;
    const double asked = aim(control, stage, k), reached = entry(control.stress, k);
    ServoWatch watch = entry(control.watches, k);
    watch.see_error(reached - asked);
    if (watch.lowest >= -allowed && watch.highest <= allowed) continue;
    throw RunFailure(fmt::format(
        "mixed_control: the stress {} is {:.6g} Pa at the end of stage '{}', step {}, t = "
        "{:.6g} s; target {:.6g} Pa; its error is {:.6g} to {:.6g} Pa over the last tenth of the "
        "stage, allowed: within {:.3g} Pa (stage.cell.tolerance); use a longer stage, a smaller "
        "stage.cell.response (less inertia: the stress is followed faster) or a denser powder",
        entry(names, k), reached, name, clock.step, clock.time, asked, watch.lowest, watch.highest,
        allowed));
  }
}

// Share of the stage's strain applied in the step that begins `since` after its start.
double share_in_step(const Stage& stage, double since, double cut, double dt) {
  const auto share = [&](double t) {
    return kernels::cut_travel(t / stage.duration, stage.ramp, cut / stage.duration);
  };
  return share(since + dt) - share(since);
}

double asked_for(const MixedControl& control, const Stage& stage, int part, double since) {
  const double share = since < stage.rise ? kernels::ramp_speed(since / stage.rise) : 1;
  const double at_begin = entry(control.servos, part).at_begin;
  return at_begin + share * (aim(control, stage, part) - at_begin);
}

// Rate of the component over the next step, 1/s.
double driven_by_stress(const Stage& stage, int part, double volume,
                        const kernels::TouchSums& touching, const Clock& clock,
                        MixedControl& control) {
  MixedControl::Servo& servo = entry(control.servos, part);
  const double sides = MixedControl::is_shear(part) ? 2 : 1;  // xy and yx
  const double stress = entry(control.stress, part);
  const double missing = sides * (entry(control.asked, part) - stress) * volume;
  const double minimum = sides * kernels::min_tool_mass(touching, clock.dt, clock.safety);
  const kernels::ServoState now = kernels::with_mass({servo.mass, servo.speed, servo.dragged},
                                                     std::max(sides * stage.mass, minimum));
  const double damping = sides * stage.damping * std::sqrt(now.mass / (sides * stage.mass));
  // Not limited on its way: the particles of a cell follow its motion without a momentum that could carry it on.
  constexpr kernels::SpeedLimits limits{1e300, 1e300};
  const kernels::ServoState next =
      kernels::servo_step(now, missing, damping, limits, 0.5 * (clock.dt_before + clock.dt));
  servo.mass = next.mass;
  servo.speed = next.speed;
  servo.dragged = next.dragged;
  return next.speed;
}

// How well the component keeps to its target. A ratio or a mean follows another stress and has no overshoot of its own.
void watch(const Stage& stage, int part, bool judged, MixedControl& control) {
  ServoWatch& seen = entry(control.watches, part);
  const double stress = entry(control.stress, part), target = aim(control, stage, part);
  if (entry(stage.law, part) == Law::stress)
    seen.see_force(target < 0 ? -stress : stress,
                   std::max(std::abs(target), std::abs(entry(control.servos, part).at_begin)));
  if (judged) seen.see_error(stress - entry(control.asked, part));
}

void begin_stage(const Stage* last, const Stage* stage, MixedControl& control) {
  control.cut = std::numeric_limits<double>::infinity();
  if (stage == nullptr) return;
  for (int k = 0; k < MixedControl::parts; ++k) {
    if (entry(stage->law, k) == Law::strain) continue;
    MixedControl::Servo& servo = entry(control.servos, k);
    servo.at_begin = entry(control.stress, k);
    entry(control.watches, k) = {.overshoot = entry(control.watches, k).overshoot};
    if (last == nullptr || entry(last->law, k) == Law::strain) servo.mass = stage->mass;
  }
}

}  // namespace

Rates rates_of(MixedControl& control, const ToolProgram& program, const Clock& clock, double volume,
               const std::array<kernels::TouchSums, MixedControl::parts>& touching) {
  const std::size_t number = program.stage_at(clock.time);
  const Stage* stage = number < control.stages.size() ? &control.stages[number] : nullptr;
  if (number != control.stage) {
    const Stage* last =
        control.stage < control.stages.size() ? &control.stages[control.stage] : nullptr;
    const bool ended_early = std::isfinite(control.cut);
    if (last != nullptr && last->holds_stress() && !ended_early)
      check_held(*last, program.stages[control.stage].name, control, clock);
    begin_stage(last, stage, control);
  }
  control.stage = number;
  Rates rates;
  if (stage == nullptr) return rates;
  const double begin = program.stages[number].begin, since = clock.time - begin;
  const double share = share_in_step(*stage, since, control.cut - begin, clock.dt) / clock.dt;
  for (int k = 0; k < MixedControl::parts; ++k) {
    if (entry(stage->law, k) == Law::strain) {
      entry(rates.deformation, k) = share * entry(stage->strain, k);
      entry(control.servos, k) = {};
      entry(control.asked, k) = 0;
    } else {
      entry(control.asked, k) = asked_for(control, *stage, k, since);
      watch(*stage, k, is_judged(program.stages[number], clock.time), control);
      entry(rates.deformation, k) =
          driven_by_stress(*stage, k, volume, entry(touching, k), clock, control);
    }
  }
  for (std::size_t k = 0; k < 3; ++k) rates.spin[k] = share * stage->rotation[k];
  return rates;
}

void add_strain(MixedControl& control, const Rates& rates, double dt) {
  for (int k = 0; k < MixedControl::parts; ++k)
    entry(control.strain, k) += entry(rates.deformation, k) * dt;
  for (std::size_t k = 0; k < 3; ++k) control.rotation[k] += rates.spin[k] * dt;
}

}  // namespace pulvis
