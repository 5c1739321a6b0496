#include "cli/laboratory/lab_friction.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace pulvis::lab {

double wall_exponent(double stress_ratio, double length, double diameter) {
  return 4 * stress_ratio * length / diameter;
}

double largest_ratio(double exponent) {
  return exponent > 0 ? 1 / (std::numbers::e * exponent) : std::numeric_limits<double>::infinity();
}

// Newton's method from mu = r, which lies below the solution. mu exp(-k mu) is concave up to there, so
// no step overshoots, and the iteration ends when rounding reverses one. Near k r = 1/e, where two
// solutions merge, each step halves the distance: 60 of them reach round-off.
std::optional<double> friction_coefficient(double ratio, double exponent) {
  constexpr int max_steps = 100;
  if (ratio > largest_ratio(exponent)) return std::nullopt;
  double mu = ratio;
  for (int step = 0; step < max_steps; ++step) {
    const double slope = 1 - exponent * mu;  // of mu exp(-k mu), over exp(-k mu)
    if (!(slope > 0)) break;
    const double next = mu - (mu - ratio * std::exp(exponent * mu)) / slope;
    if (!(next > mu)) break;
    mu = next;
  }
  return mu;
}

}  // namespace pulvis::lab
