// An adhesive elastic ball on a rigid plane, and the spring that holds it.
//
// Source   Johnson, Kendall & Roberts (1971); equilibria and stability after Maugis (1992):
//            F = K a^3/R - sqrt(6 pi w K a^3),   delta = a^2/R - sqrt(8 pi w a/(3K)),   K = 4/3 E*
//          Displacement control: contact is lost at d delta/da = 0: a_m^3 = pi w R^2/(8 E*), F = -5/6 pi w R.
//          With q^2 = a/a_m: F = (pi w R/6)(q^6 - 6 q^3), delta = (a_m^2/R)(q^4 - 4 q), q >= 1. Load control:
//          contact is lost at q^3 = 3, F = -3/2 pi w R.
// Symbols  F force on the ball, N, < 0: attraction; delta approach, m; a contact radius, m; R radius of
//          the ball, m; w work of adhesion, J/m^2; E* of the ball, Pa; rho stiffness of the spring, N/m;
//          tau = F + rho delta, the spring force at delta = 0
// Valid    a small against R; R w^2/(E*^2 z^3) large against 1, z the range of attraction (Tabor 1977)
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "components/probe.hpp"
#include "engine/portable_math.hpp"

namespace pulvis::kernels {

struct JkrScale {
  double radius = 0, force = 0, approach = 0;  // a_m, pi w R/6, a_m^2/R

  explicit JkrScale(const AdhesiveBall& ball)
      : radius(portable::cbrt(std::numbers::pi * ball.work * ball.radius * ball.radius /
                              (8 * ball.modulus))),
        force(std::numbers::pi * ball.work * ball.radius / 6),
        approach(radius * radius / ball.radius) {}
  double force_at(double q) const { return force * q * q * q * (q * q * q - 6); }
  double approach_at(double q) const { return approach * q * (q * q * q - 4); }
  double force_slope(double q) const { return force * 6 * q * q * (q * q * q - 3); }
  double approach_slope(double q) const { return approach * 4 * (q * q * q - 1); }
};

// The pull-off force of a soft lever, N > 0.
inline double jkr_pull_off(const AdhesiveBall& ball) {
  return 1.5 * std::numbers::pi * ball.work * ball.radius;
}

struct JkrAnswer {
  bool holds = false;  // whether contact and spring have a stable equilibrium
  double q = 0;
  double force = 0;  // N
  double slope = 0;  // -, d force / d tau
};

// Where share_f F + rho delta = tau on the stable branch: right of the only minimum of that sum, where it
// is increasing and convex, so that Newton's method converges to the root from above.
inline JkrAnswer jkr_balance(const JkrScale& law, double share_f, double rho, double tau) {
  const auto sum = [&](double q) { return share_f * law.force_at(q) + rho * law.approach_at(q); };
  const auto slope = [&](double q) {
    return share_f * law.force_slope(q) + rho * law.approach_slope(q);
  };
  double low = 1, high = portable::cbrt(3.0);
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (slope(middle) < 0 ? low : high) = middle;
  }
  JkrAnswer answer;
  if (!(tau >= sum(high))) return answer;
  answer.holds = true;
  double q = 2;
  while (sum(q) < tau) q *= 2;
  for (int i = 0; i < 100; ++i) {
    const double next = std::max(high, q - (sum(q) - tau) / slope(q));
    const bool settled = !(next < q * (1 - 1e-15));
    q = next;
    if (settled) break;
  }
  answer.q = q;
  answer.force = law.force_at(q);
  answer.slope = law.force_slope(q) / slope(q);
  return answer;
}

// Contact radius, m, at an approach; 0 if contact is lost.
inline double jkr_radius(const AdhesiveBall& ball, double approach) {
  const JkrScale law(ball);
  const JkrAnswer at = jkr_balance(law, 0, 1, approach);
  return at.holds ? law.radius * at.q * at.q : 0;
}

// Pressure at the centre of the contact circle, Pa.
inline double jkr_pressure(const AdhesiveBall& ball, double radius) {
  return 2 * ball.modulus * radius / (std::numbers::pi * ball.radius) -
         std::sqrt(2 * ball.work * ball.modulus / (std::numbers::pi * radius));
}

}  // namespace pulvis::kernels
