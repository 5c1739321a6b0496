// cell_control: the stress of the periodic cell, the work done by the cell, and its deformation rate in the next step.
//
// Law      an image of particle b is at b + h n (h: the cell's vectors, n: integers). A contact force f on the
//          sampled side a against that image does work at a rate f . (h' n) through the cell alone:
//            stress = sum f (x) l / (area thickness),   l = h n + x_b - x_a from centre to centre, tension > 0
//                   = (sum f (x) h n - sum F (x) x) / (area thickness),   F: the net force on a particle
//          (Christoffersen, Mehrabadi & Nemat-Nasser 1981). Without the second sum it is the stress across the
//          boundaries, which contains the inertia of the particles. cell_kick gives them the homogeneous motion without
//          a reaction on the servo, so that only l is the arm on which f resists a strain (Parrinello & Rahman 1981):
//          a servo driven by the stress across the boundaries feeds vibrations
// Control  systems/cell/mixed_control.hpp
// Vectors  by the midpoint rule, (h_(n+1) - h_n)/dt = L (h_n + h_(n+1))/2: their area follows the trace of L
// Runs     after cell_load; cell_kick and cell_motion apply it
// Watches  that target stresses are reached when their stage ends
//
// wall_control: the same for the four planes of a die, with the stresses that they carry. Opposite planes move
// symmetrically about their centre.
//
// Runs     after tool_reaction; tool_motion applies it in the next step
#include <algorithm>
#include <array>
#include <cmath>

#include "engine/chunk_lane.hpp"
#include "engine/entry.hpp"
#include "systems/cell/mixed_control.hpp"
#include "systems/cell/systems.hpp"
#include "systems/tools/servo_motion.hpp"
#include "systems/tools/servo_touch.hpp"

namespace pulvis {
namespace {

using kernels::TouchSums;
using Parts = std::array<double, MixedControl::parts>;

// Over all rows and particles of all ranks.
struct CellSums {
  std::array<ExactSum, 11> exact;

  void add(int from, const Tensor2& t) {
    for (int k = 0; k < 4; ++k) entry(exact, from + k).add(entry(t.t, k));
  }
  Tensor2 tensor(int from) const {
    Tensor2 t;
    for (int k = 0; k < 4; ++k) entry(t.t, k) = entry(exact, from + k).value();
    return t;
  }
  Tensor2 border_force() const { return tensor(0); }     // N
  Tensor2 moment() const { return tensor(4); }           // N m, of the net forces on the particles
  double kick_work() const { return exact[8].value(); }  // J
  TouchSums resistance() const { return {exact[9].value(), exact[10].value()}; }  // N m, N m s
};

void add_borders(const cell_control& s, CellSums& sums) {
  for (int r = 0; r < s.borders.rows.pair.rows(); ++r) {
    const Row<Contact> row(r);
    const Image n{s.borders.image(row, 0), s.borders.image(row, 1)};
    if (s.borders.rows.touches(row) == 0 || n == Image{}) continue;
    if (!s.bodies->owns(s.borders.rows.pair(row, 0))) continue;  // added by its owner
    Tensor2 force;
    for (int i = 0; i < 2; ++i) {
      double all = 0;
      for (int g = 0; g < edge_points; ++g) all += s.borders.rows.force(row, 2 * g + i);
      for (int k = 0; k < 2; ++k) entry(force.t, 2 * i + k) = all * entry(n, k);
    }
    sums.add(0, force);
  }
}

void add_particles(const cell_control& s, CellSums& sums) {
  const Row<Particle> particle;
  for (const int slot : s.bodies->own_slots) {
    const ChunkLane at(slot);
    const auto of = [&](const auto& column, int k) {
      return column.chunk(at.chunk)(particle, k)[at.lane];
    };
    const auto& [centre, force, resistance, kick_work] = s.particles;
    const double x = of(centre, 0), y = of(centre, 1), fx = of(force, 0), fy = of(force, 1);
    sums.add(4, {{fx * x, fx * y, fy * x, fy * y}});
    sums.exact[8].add(of(kick_work, 0));
    sums.exact[9].add(of(resistance, 0));
    sums.exact[10].add(of(resistance, 1));
  }
}

// `moment`: N m, of the net forces on the particles about the origin.
Parts stress_of(const PeriodicCell& cell, const Tensor2& moment) {
  Tensor2 transposed = cell.vectors;
  std::swap(transposed.t[1], transposed.t[2]);
  const Tensor2 sum =
      (1 / (cell.area() * cell.thickness)) * (cell.border_force * transposed + -1.0 * moment);
  return {sum.t[0], sum.t[3], 0.5 * (sum.t[1] + sum.t[2])};
}

}  // namespace

void cell_control::operator()() const {
  PeriodicCell& now = *control.cell;
  CellSums sums;
  add_borders(*this, sums);
  add_particles(*this, sums);
  sum_of_ranks(link, sums.exact);
  const Tensor2 force = sums.border_force();
  const double work =
      0.5 * product(now.border_force + force, now.rate) * clock->dt_before + sums.kick_work();
  control.totals->external_work += work;
  control.totals->largest_work = std::max(control.totals->largest_work, std::abs(work));
  now.border_force = force;
  now.control.stress = stress_of(now, sums.moment());

  const TouchSums touching = sums.resistance();
  const Rates rates = rates_of(now.control, *program, *clock, now.area() * now.thickness,
                               {touching, touching, touching});
  const auto& rate = rates.deformation;
  const Tensor2 gradient{{rate[0], rate[2] - rates.spin, rate[2] + rates.spin, rate[1]}};
  now.gradient = gradient;
  const Tensor2 half = (0.5 * clock->dt) * gradient;
  constexpr Tensor2 one{{1, 0, 0, 1}};
  now.next = (one + -1.0 * half).inverse() * ((one + half) * now.vectors);
  const Tensor2 next_rate = (1 / clock->dt) * (now.next + -1.0 * now.vectors);
  now.change = (next_rate + -1.0 * now.rate) * now.vectors.inverse();
}

// Motion of the cell.
void cell_motion::operator()() const {
  PeriodicCell& now = *cell;
  now.rate = (1 / clock->dt) * (now.next + -1.0 * now.vectors);
  now.vectors = now.next;
  const auto& l = now.gradient.t;
  add_strain(now.control, {{l[0], l[3], 0.5 * (l[1] + l[2])}, 0.5 * (l[2] - l[1])}, clock->dt);
}

// ---- walls ----------------------------------------------------------------------------------------
namespace {

// Contacts of two planes, each moving by half of the strain, weighted with the squares of their displacements.
TouchSums pressed_by(int low, int high, double size, const wall_control& s) {
  TouchSum sums;
  const double square = 0.25 * size * size;
  for (int r = 0; r < s.contacts.pair.rows(); ++r) {
    const Row<ToolContact> row(r);
    const int tool = s.contacts.pair(row, 2);
    if (s.contacts.touches(row) == 0 || (tool != low && tool != high)) continue;
    sums.add(touching_of(row, s.contacts, s.law, s.rules->stiffest_weld()), square);
  }
  return sums.of_ranks(s.drive.link);
}

}  // namespace

void wall_control::operator()() const {
  DrivenWalls& now = *drive.walls;
  const Row<Tool> left(now.left), right(now.right), bottom(now.bottom), top(now.top);
  const double width = position(right, 0) - position(left, 0);
  const double height = position(top, 1) - position(bottom, 1);
  now.control.stress = {-0.5 * (force(right, 0) - force(left, 0)) / (height * now.thickness),
                        -0.5 * (force(top, 1) - force(bottom, 1)) / (width * now.thickness), 0};
  const Rates rates = rates_of(now.control, *program, *clock, width * height * now.thickness,
                               {pressed_by(now.left, now.right, width, *this),
                                pressed_by(now.bottom, now.top, height, *this), TouchSums{}});
  const auto move = [&](Row<Tool> low, Row<Tool> high, int axis, double size, double rate) {
    const double half = 0.5 * rate * clock->dt;  // midpoint rule, as in a cell
    const double speed = 0.5 * rate * size / (1 - half);
    drive.velocity(low, axis) = -speed;
    drive.velocity(high, axis) = speed;
  };
  move(left, right, 0, width, rates.deformation[0]);
  move(bottom, top, 1, height, rates.deformation[1]);
  add_strain(now.control, rates, clock->dt);
}

}  // namespace pulvis
