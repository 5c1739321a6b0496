#include "scenes/lever/linear_response.hpp"

#include <algorithm>
#include <cmath>

#include "components/solid.hpp"

namespace pulvis {
namespace {

double largest_of(std::span<const double> values) {
  double largest = 0;
  for (const double v : values) largest = std::max(largest, std::abs(v));
  return largest;
}

double energy_of(const World& world) {
  double sum = 0;
  const auto add = [&](const auto& energy) {
    for (std::size_t e = 0; e < energy.table.rows; ++e) sum += energy.values()[e];
  };
  add(world.column<ElementEnergy>());
  if (world.has<TetrahedronEnergy>()) add(world.column<TetrahedronEnergy>());
  return sum;
}

}  // namespace

LinearResponse linear_response(World& world, StaticSolver& solver, std::span<const double> forces) {
  constexpr double small = 1e-30;  // m: makes squares of strains negligible
  constexpr double enough = 1e-13;
  const int maximum = solver.in_extended_precision() ? 30 : 10;
  double* const u = world.column<Displacement>().values();
  LinearResponse r{solver.respond(forces), std::vector<double>(forces.size())};
  const double largest = largest_of(r.displacements);
  if (largest == 0) return r;
  const double scale = small / largest;
  r.correction = 1;
  for (r.corrections = 1; r.corrections <= maximum; ++r.corrections) {
    for (std::size_t k = 0; k < forces.size(); ++k) u[k] = scale * r.displacements[k];
    solver.look();
    const double* held = world.column<SolidForce>().values();
    std::vector<double> missing(forces.size());
    double work = 0;
    for (std::size_t k = 0; k < forces.size(); ++k) {
      r.forces[k] = held[k] / scale;
      missing[k] = forces[k] - r.forces[k];
      work += forces[k] * r.displacements[k];
    }
    r.energy_error = std::abs(2 * energy_of(world) / (work * scale * scale) - 1);
    const std::vector<double> step = solver.respond(missing);
    const double size = largest_of(step) / largest;
    const bool shrinks = size <= 0.5 * r.correction;
    r.correction = size;
    // Once corrections stop shrinking, either round-off is reached or the factors are useless.
    if (!(size >= enough && shrinks)) break;
    for (std::size_t k = 0; k < step.size(); ++k) r.displacements[k] += step[k];
  }
  std::fill(u, u + forces.size(), 0.0);
  return r;
}

}  // namespace pulvis
