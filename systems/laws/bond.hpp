// Bond response: a cohesive law with two stiffnesses, bilinear in every mode.
//
// Law      w0 = (k_n <d_n>^2 + k_t d_t^2)/2 [J/m^2], the undamaged energy of the opening d; lambda = sqrt(2 w0)
//          b = k_t d_t^2/(2 w0), the shear share; onset and end are mixed with b^eta (Benzeggagh & Kenane 1996):
//            lambda_0^2 = sigma_c^2/k_n + (tau_c^2/k_t - sigma_c^2/k_n) b^eta
//            G          = G_I + (G_II - G_I) b^eta,      lambda_f = 2 G/lambda_0
//          d = lambda_f (lambda - lambda_0)/(lambda (lambda_f - lambda_0)), never decreasing (Camanho & Davila
//          2002; Turon, Camanho, Costa & Davila 2006, in energy norms so that k_n and k_t may differ)
//          traction (1 - d) (k_n d_n, k_t d_t): unloads to the origin
// Damage   in one mode dissipates G s, s = (lambda - lambda_0)/(lambda_f - lambda_0): all of G at the end
// Compression (d_n < 0) causes no damage.
#pragma once

#include <algorithm>
#include <cmath>

#include "engine/portable_math.hpp"

namespace pulvis::kernels {

struct CohesiveLaw {
  double k_n, k_t;        // Pa/m
  double sigma, tau;      // Pa
  double g_i, g_ii;       // J/m^2
  double mixed_exponent;  // eta
};

struct CohesiveDamage {
  double d;      // -, new value; 1: broken
  double spent;  // J/m^2, dissipated by its growth
  double shear;  // -, b
};

// b^eta, and the energy for a mode mix. (J/m^2)
inline double mixed_share(const CohesiveLaw& law, double shear) {
  return law.mixed_exponent == 2 ? shear * shear : portable::pow(shear, law.mixed_exponent);
}
inline double fracture_energy(const CohesiveLaw& law, double shear) {
  return law.g_i + (law.g_ii - law.g_i) * mixed_share(law, shear);
}

inline CohesiveDamage cohesive_damage(const CohesiveLaw& law, double d_n, double d_t,
                                      double before) {
  const double open = std::max(d_n, 0.0);
  const double normal = law.k_n * open * open, along = law.k_t * d_t * d_t, both = normal + along;
  if (both <= 0) return {before, 0, 0};
  const double shear = along / both;
  const double onset_n = law.sigma * law.sigma / law.k_n, onset_t = law.tau * law.tau / law.k_t;
  const double onset = std::sqrt(onset_n + (onset_t - onset_n) * mixed_share(law, shear));
  const double energy = fracture_energy(law, shear);
  const double end = 2 * energy / onset;
  const double lambda = std::sqrt(both);
  // Progress of damage d, as a share of the way from onset to end.
  const auto share = [&](double d) { return onset * d / (end - d * (end - onset)); };
  if (lambda >= end) return {1, energy * (1 - share(before)), shear};
  if (lambda <= onset) return {before, 0, shear};
  const double d = end * (lambda - onset) / (lambda * (end - onset));
  if (d <= before) return {before, 0, shear};
  return {d, energy * (share(d) - share(before)), shear};
}

}  // namespace pulvis::kernels
