// cell_control: the stress across the borders of the periodic cell, the work that the cell does, and how fast it deforms in
// the next step.
//
// Law      an image of particle b stands at b + h n (h: the cell's vectors, n: whole numbers). A contact force f on the
//          sampled side against that image does work at a rate f . (h' n) through the cell alone: stress =
//          sum f (x) h n / (area thickness), tension > 0 (Christoffersen, Mehrabadi & Nemat-Nasser 1981, with the
//          borders as section)
// Drives   parts of the rate of deformation that a strain drives follow the stage; those that a stress drives move as
//          a mass that the missing stress pushes and a dashpot damps (systems/tools/servo_kernel.hpp): force
//          (asked - stress) area thickness, mass in kg m^2, speed in 1/s
// Vectors  by the midpoint rule, (h_(n+1) - h_n)/dt = L (h_n + h_(n+1))/2: their area follows the trace of L
// Runs     after the contacts of the step; cell_kick and cell_motion carry it out
// Watches  that asked stresses are held when their stage ends
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/entry.hpp"
#include "engine/run_failure.hpp"
#include "systems/cell/systems.hpp"
#include "systems/tools/servo_kernel.hpp"
#include "systems/tools/servo_touch.hpp"
#include "systems/tools/tool_kernel.hpp"

namespace pulvis {
namespace {

using Stage = PeriodicCell::Stage;
using Parts = std::array<double, PeriodicCell::parts>;
constexpr std::array<const char*, PeriodicCell::parts> names{"xx", "yy", "xy"};

struct BorderSums {
  Tensor2 force;                // N
  kernels::TouchSums touching;  // of one vector's length each: N/m, N s/m, times m^2
};

BorderSums across_borders(const cell_control& s) {
  BorderSums sums;
  for (int r = 0; r < s.borders.rows.pair.rows(); ++r) {
    const Row<Contact> row(r);
    const Image n{s.borders.image(row, 0), s.borders.image(row, 1)};
    if (s.borders.rows.touches(row) == 0 || n == Image{}) continue;
    const Point way = s.cell->vectors * n;
    const double square = way[0] * way[0] + way[1] * way[1];
    for (int g = 0; g < edge_points; ++g)
      for (int i = 0; i < 2; ++i)
        for (int k = 0; k < 2; ++k)
          sums.force.t[static_cast<std::size_t>(2 * i + k)] +=
              s.borders.rows.force(row, 2 * g + i) * entry(n, k);
    const kernels::TouchSums one =
        touching_of(row, s.borders.rows, s.borders.law, s.rules->stiffest_weld());
    sums.touching.stiffness += square * one.stiffness;
    sums.touching.damping += square * one.damping;
  }
  return sums;
}

Parts stress_of(const PeriodicCell& cell) {
  Tensor2 transposed = cell.vectors;
  std::swap(transposed.t[1], transposed.t[2]);
  const Tensor2 sum = (1 / (cell.area() * cell.thickness)) * (cell.border_force * transposed);
  return {sum.t[0], sum.t[3], 0.5 * (sum.t[1] + sum.t[2])};
}

void check_held(const Stage& stage, const PeriodicCell& cell, const Clock& clock) {
  double largest = 0;
  for (int k = 0; k < PeriodicCell::parts; ++k)
    if (entry(stage.stress_driven, k))
      largest = std::max(largest, std::abs(entry(stage.stress, k)));
  for (int k = 0; k < PeriodicCell::parts; ++k) {
    if (!entry(stage.stress_driven, k)) continue;
    if (std::abs(entry(cell.stress, k) - entry(stage.stress, k)) <= stage.tolerance * largest)
      continue;
    throw RunFailure(fmt::format(
        "cell_control: the cell's stress {} is {:.6g} Pa at the end of stage '{}', step {}, t = "
        "{:.6g} s; asked for {:.6g} Pa, allowed: within {:.3g} Pa of it (stage.cell.tolerance); a "
        "longer stage or a denser powder would reach it",
        entry(names, k), entry(cell.stress, k), stage.name, clock.step, clock.time,
        entry(stage.stress, k), stage.tolerance * largest));
  }
}

// Of the displacement, that the stage has come in the step that ends at `time`.
double share_in_step(const Stage& stage, double time, double dt) {
  const auto share = [&](double t) {
    return kernels::cut_travel((t - stage.begin) / stage.duration, stage.ramp, 1e300);
  };
  return share(time + dt) - share(time);
}

double asked_for(const Stage& stage, int part, double at_begin, double since) {
  const double share = since < stage.rise ? kernels::ramp_speed(since / stage.rise) : 1;
  return at_begin + share * (entry(stage.stress, part) - at_begin);
}

// Rate of the part over the next step, 1/s.
double driven_by_stress(const Stage& stage, int part, bool new_stage, bool was_driven,
                        const kernels::TouchSums& touching, const Clock& clock,
                        PeriodicCell& cell) {
  PeriodicCell::Drive& drive = entry(cell.drives, part);
  if (new_stage) drive.at_begin = entry(cell.stress, part);
  if (new_stage && !was_driven) drive.mass = stage.mass;
  entry(cell.asked, part) = asked_for(stage, part, drive.at_begin, clock.time - stage.begin);
  const double sides = part == PeriodicCell::xy ? 2 : 1;  // xy and yx
  const double missing =
      sides * (entry(cell.asked, part) - entry(cell.stress, part)) * cell.area() * cell.thickness;
  const double minimum = sides * kernels::min_tool_mass(touching, clock.dt, clock.safety);
  const kernels::ServoState now = kernels::with_mass({drive.mass, drive.speed, drive.dragged},
                                                     std::max(sides * stage.mass, minimum));
  const double damping = sides * stage.damping * std::sqrt(now.mass / (sides * stage.mass));
  const kernels::ServoState next =
      kernels::servo_step(now, missing, damping, 1e300, 0.5 * (clock.dt_before + clock.dt));
  drive.mass = next.mass;
  drive.speed = next.speed;
  drive.dragged = next.dragged;
  return next.speed;
}

}  // namespace

void cell_control::operator()() const {
  PeriodicCell& now = *cell;
  const BorderSums sums = across_borders(*this);
  double work = 0.5 * product(now.border_force + sums.force, now.rate) * clock->dt_before;
  for (const int slot : bodies->slot_of_number) work += entry(kick_work.values(), slot);
  totals->external_work += work;
  totals->largest_work = std::max(totals->largest_work, std::abs(work));
  now.border_force = sums.force;
  now.stress = stress_of(now);

  const std::size_t number = now.stage_at(clock->time);
  const bool new_stage = number != now.stage;
  const Stage* last = now.stage < now.stages.size() ? &now.stages[now.stage] : nullptr;
  if (new_stage && last != nullptr && last->holds_stress()) check_held(*last, now, *clock);
  Parts rate{};
  double spin = 0;
  if (number < now.stages.size()) {
    const Stage& stage = now.stages[number];
    const double share = share_in_step(stage, clock->time, clock->dt) / clock->dt;
    for (int k = 0; k < PeriodicCell::parts; ++k) {
      const bool was_driven = last != nullptr && entry(last->stress_driven, k);
      if (entry(stage.stress_driven, k)) {
        entry(rate, k) =
            driven_by_stress(stage, k, new_stage, was_driven, sums.touching, *clock, now);
      } else {
        entry(rate, k) = share * entry(stage.strain, k);
        entry(now.drives, k) = {};
        entry(now.asked, k) = 0;
      }
    }
    spin = share * stage.rotation;
  }
  now.stage = number;
  const Tensor2 gradient{{rate[0], rate[2] - spin, rate[2] + spin, rate[1]}};
  now.gradient = gradient;
  const Tensor2 half = (0.5 * clock->dt) * gradient;
  constexpr Tensor2 one{{1, 0, 0, 1}};
  now.next = (one + -1.0 * half).inverse() * ((one + half) * now.vectors);
  const Tensor2 next_rate = (1 / clock->dt) * (now.next + -1.0 * now.vectors);
  now.change = (next_rate + -1.0 * now.rate) * now.vectors.inverse();
}

// The step itself.
void cell_motion::operator()() const {
  PeriodicCell& now = *cell;
  now.rate = (1 / clock->dt) * (now.next + -1.0 * now.vectors);
  now.vectors = now.next;
  const auto& l = now.gradient.t;
  now.strain[PeriodicCell::xx] += l[0] * clock->dt;
  now.strain[PeriodicCell::yy] += l[3] * clock->dt;
  now.strain[PeriodicCell::xy] += 0.5 * (l[1] + l[2]) * clock->dt;
  now.rotation += 0.5 * (l[2] - l[1]) * clock->dt;
}

}  // namespace pulvis
