// cell_control: the stress of the periodic cell, the work done by the cell, and its deformation rate in the next step.
//
// Law      an image of particle b is at b + h n (h: the cell's vectors, n: integers). A contact force f on the
//          sampled side a against that image does work at a rate f . (h' n) through the cell alone:
//            stress = sum f (x) l / volume,   l = h n + x_b - x_a from centre to centre, tension > 0
//                   = (sum f (x) h n - sum F (x) x) / volume,   F: the net force on a particle
//          (Christoffersen, Mehrabadi & Nemat-Nasser 1981). Without the second sum it is the stress across the
//          boundaries, which contains the inertia of the particles. cell_kick gives them the homogeneous motion without
//          a reaction on the servo, so that only l is the arm on which f resists a strain (Parrinello & Rahman 1981):
//          a servo driven by the stress across the boundaries feeds vibrations
// Control  systems/cell/mixed_control.hpp
// Vectors  by the midpoint rule, (h_(n+1) - h_n)/dt = L (h_n + h_(n+1))/2: their volume follows the trace of L
// Runs     after cell_load; cell_kick and cell_motion apply it
// Watches  that target stresses are reached when their stage ends
//
// wall_control: the same for the planes of a die, with the stresses that they carry. Opposite planes move
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

// Over all contacts and particles of all ranks.
template <class D>
struct CellSums {
  static constexpr std::size_t numbers = std::size_t{D::axes} * D::axes;
  std::array<ExactSum, 2 * numbers + 3> exact;

  void add_border_force(const Tensor<D>& t) { add(0, t); }
  void add_moment(const Tensor<D>& t) { add(numbers, t); }
  void add_kick_work(double work) { exact[2 * numbers].add(work); }
  void add_resistance(double stiffness, double damping) {
    exact[2 * numbers + 1].add(stiffness);
    exact[2 * numbers + 2].add(damping);
  }
  Tensor<D> border_force() const { return tensor(0); }             // N
  Tensor<D> moment() const { return tensor(numbers); }             // N m
  double kick_work() const { return exact[2 * numbers].value(); }  // J
  TouchSums resistance() const {                                   // N m, N m s
    return {exact[2 * numbers + 1].value(), exact[2 * numbers + 2].value()};
  }

 private:
  void add(std::size_t from, const Tensor<D>& t) {
    for (std::size_t k = 0; k < numbers; ++k) exact[from + k].add(t.t[k]);
  }
  Tensor<D> tensor(std::size_t from) const {
    Tensor<D> t;
    for (std::size_t k = 0; k < numbers; ++k) t.t[k] = exact[from + k].value();
    return t;
  }
};

// visit(row, force on its sampled side) for the contacts of which this rank owns that side.
template <class Visit>
void for_contacts(const cell_control<TwoD>& s, const Visit& visit) {
  const auto& rows = s.borders.pairs.rows;
  for (int r = 0; r < rows.pair.rows(); ++r) {
    const Row<Contact> row(r);
    if (rows.touches(row) == 0 || !s.bodies->owns(rows.pair(row, 0))) continue;
    Point force{};
    for (int k = 0; k < 2; ++k)
      for (int g = 0; g < edge_points; ++g) entry(force, k) += rows.force(row, 2 * g + k);
    visit(row, force);
  }
}
template <class Visit>
void for_contacts(const cell_control<ThreeD>& s, const Visit& visit) {
  const auto& rows = s.borders.pairs.rows;
  for (int p = 0; p < rows.of->count(); ++p) {
    const Row<FaceContact> first(entry(rows.of->begin, p));
    const auto& of_points = entry(rows.loads->pairs, p).own;
    if (of_points.empty() || !s.bodies->owns(rows.pair(first, 0))) continue;
    Point3 force{};
    for (const auto& f : of_points)
      for (std::size_t k = 0; k < 3; ++k) force[k] += f[k];
    visit(first, force);
  }
}

template <class D>
void add_borders(const cell_control<D>& s, CellSums<D>& sums) {
  for_contacts(s, [&](auto row, const typename D::Point& force) {
    std::array<double, D::axes> n;
    for (int k = 0; k < D::axes; ++k) entry(n, k) = s.borders.image(row, k);
    if (n == std::array<double, D::axes>{}) return;
    Tensor<D> product;
    for (std::size_t i = 0; i < D::axes; ++i)
      for (std::size_t k = 0; k < D::axes; ++k) product(i, k) = force[i] * n[k];
    sums.add_border_force(product);
  });
}

template <class D>
void add_particles(const cell_control<D>& s, CellSums<D>& sums) {
  const Row<Particle> particle;
  for (const int slot : s.bodies->own_slots) {
    const ChunkLane at(slot);
    const auto of = [&](const auto& column, std::size_t k) {
      return column.chunk(at.chunk)(particle, static_cast<int>(k))[at.lane];
    };
    const auto& [centre, force, resistance, kick_work] = s.particles;
    Tensor<D> moment;
    for (std::size_t i = 0; i < D::axes; ++i)
      for (std::size_t k = 0; k < D::axes; ++k) moment(i, k) = of(force, i) * of(centre, k);
    sums.add_moment(moment);
    sums.add_kick_work(of(kick_work, 0));
    sums.add_resistance(of(resistance, 0), of(resistance, 1));
  }
}

constexpr std::array<std::array<std::size_t, 2>, MixedControl::parts> axes_of_part{
    {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}}};

// The symmetric part.
template <class D>
Parts parts_of(const Tensor<D>& t) {
  Parts parts{};
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const auto [i, j] = axes_of_part[p];
    if (i < D::axes && j < D::axes) parts[p] = i == j ? t(i, i) : 0.5 * (t(i, j) + t(j, i));
  }
  return parts;
}

// 1/s, of the homogeneous motion with these rates.
template <class D>
Tensor<D> gradient_of(const Rates& rates) {
  Tensor<D> gradient;
  for (std::size_t p = 0; p < rates.deformation.size(); ++p) {
    const auto [i, j] = axes_of_part[p];
    if (i < D::axes && j < D::axes) gradient(i, j) = gradient(j, i) = rates.deformation[p];
  }
  const auto add_spin = [&](std::size_t i, std::size_t j, double spin) {
    gradient(i, j) -= spin;
    gradient(j, i) += spin;
  };
  add_spin(0, 1, rates.spin[2]);
  if constexpr (D::axes == 3) {
    add_spin(1, 2, rates.spin[0]);
    add_spin(2, 0, rates.spin[1]);
  }
  return gradient;
}

// `moment`: N m, of the net forces on the particles about the origin.
template <class D>
Parts stress_of(const PeriodicCell<D>& cell, const Tensor<D>& moment) {
  return parts_of((1 / cell.volume()) *
                  (cell.border_force * cell.vectors.transposed() + -1.0 * moment));
}

}  // namespace

template <class D>
void cell_control<D>::operator()() const {
  PeriodicCell<D>& now = *control.cell;
  CellSums<D> sums;
  add_borders(*this, sums);
  add_particles(*this, sums);
  sum_of_ranks(link, sums.exact);
  const Tensor<D> force = sums.border_force();
  const double work =
      0.5 * product(now.border_force + force, now.rate) * clock->dt_before + sums.kick_work();
  control.totals->external_work += work;
  control.totals->largest_work = std::max(control.totals->largest_work, std::abs(work));
  now.border_force = force;
  now.control.stress = stress_of(now, sums.moment());

  std::array<TouchSums, MixedControl::parts> touching;
  touching.fill(sums.resistance());
  now.gradient = gradient_of<D>(rates_of(now.control, *program, *clock, now.volume(), touching));
  const Tensor<D> half = (0.5 * clock->dt) * now.gradient;
  constexpr Tensor<D> one = Tensor<D>::one();
  now.next = (one + -1.0 * half).inverse() * ((one + half) * now.vectors);
  const Tensor<D> next_rate = (1 / clock->dt) * (now.next + -1.0 * now.vectors);
  now.change = (next_rate + -1.0 * now.rate) * now.vectors.inverse();
}
template struct cell_control<TwoD>;
template struct cell_control<ThreeD>;

// Motion of the cell.
template <class D>
void cell_motion<D>::operator()() const {
  PeriodicCell<D>& now = *cell;
  now.rate = (1 / clock->dt) * (now.next + -1.0 * now.vectors);
  now.vectors = now.next;
  const Tensor<D>& l = now.gradient;
  Rates rates{parts_of(l), {}};
  rates.spin[2] = 0.5 * (l(1, 0) - l(0, 1));
  if constexpr (D::axes == 3) {
    rates.spin[0] = 0.5 * (l(2, 1) - l(1, 2));
    rates.spin[1] = 0.5 * (l(0, 2) - l(2, 0));
  }
  add_strain(now.control, rates, clock->dt);
}
template struct cell_motion<TwoD>;
template struct cell_motion<ThreeD>;

// ---- walls ----------------------------------------------------------------------------------------
namespace {

// Contacts of two planes, each moving by half of the strain, weighted with the squares of their displacements.
template <class D>
TouchSums pressed_by(const DrivenWalls::Axis& walls, double size, const wall_control<D>& s) {
  const auto& [rows, law] = s.contacts;
  TouchSum sums;
  const double square = 0.25 * size * size;
  for (int r = 0; r < rows.pair.rows(); ++r) {
    const Row<typename D::ToolContact> row(r);
    const int tool = rows.pair(row, 2);
    if (rows.touches(row) == 0 || (tool != walls.low && tool != walls.high)) continue;
    sums.add(touching_of(s.bodies, row, rows, law, s.rules->stiffest_weld()), square);
  }
  return sums.of_ranks(s.drive.link);
}

}  // namespace

template <class D>
void wall_control<D>::operator()() const {
  DrivenWalls& now = *drive.walls;
  std::array<double, D::axes> size;
  double volume = now.thickness;
  for (int k = 0; k < D::axes; ++k) {
    const auto [low, high] = entry(now.walls, k);
    entry(size, k) = position(Row<Tool>(high), k) - position(Row<Tool>(low), k);
    volume *= entry(size, k);
  }
  std::array<TouchSums, MixedControl::parts> touching{};
  now.control.stress.fill(0);
  for (int k = 0; k < D::axes; ++k) {
    const auto [low, high] = entry(now.walls, k);
    const double area = volume / entry(size, k);
    entry(now.control.stress, k) =
        -0.5 * (force(Row<Tool>(high), k) - force(Row<Tool>(low), k)) / area;
    entry(touching, k) = pressed_by({low, high}, entry(size, k), *this);
  }
  const Rates rates = rates_of(now.control, *program, *clock, volume, touching);
  for (int k = 0; k < D::axes; ++k) {
    const auto [low, high] = entry(now.walls, k);
    const double rate = entry(rates.deformation, k);
    const double half = 0.5 * rate * clock->dt;  // midpoint rule, as in a cell
    const double speed = 0.5 * rate * entry(size, k) / (1 - half);
    drive.velocity(Row<Tool>(low), k) = -speed;
    drive.velocity(Row<Tool>(high), k) = speed;
  }
  add_strain(now.control, rates, clock->dt);
}
template struct wall_control<TwoD>;
template struct wall_control<ThreeD>;

}  // namespace pulvis
