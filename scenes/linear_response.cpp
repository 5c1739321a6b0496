#include "scenes/linear_response.hpp"

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

}  // namespace

LinearResponse linear_response(World& world, StaticSolver& solver, std::span<const double> forces) {
  constexpr double small = 1e-30;  // m: squares of strains are nothing beside them
  constexpr double enough = 1e-13;
  constexpr int most = 10;
  double* const u = world.column<Displacement>().values();
  LinearResponse r{solver.respond(forces), std::vector<double>(forces.size())};
  const double largest = largest_of(r.displacements);
  if (largest == 0) return r;
  const double scale = small / largest;
  double before = 1;
  for (int i = 0; i < most; ++i) {
    for (std::size_t k = 0; k < forces.size(); ++k) u[k] = scale * r.displacements[k];
    solver.look();
    const double* held = world.column<SolidForce>().values();
    std::vector<double> missing(forces.size());
    for (std::size_t k = 0; k < forces.size(); ++k) {
      r.forces[k] = held[k] / scale;
      missing[k] = forces[k] - r.forces[k];
    }
    const std::vector<double> step = solver.respond(missing);
    const double size = largest_of(step) / largest;
    // Where corrections no longer shrink, round-off is reached.
    if (size < enough || size > 0.5 * before) break;
    for (std::size_t k = 0; k < step.size(); ++k) r.displacements[k] += step[k];
    before = size;
  }
  std::fill(u, u + forces.size(), 0.0);
  return r;
}

}  // namespace pulvis
