// The cohesive law of a bond against what it is: energies of the modes, the mixing of both, damage that never heals.
#include "systems/laws/bond.hpp"

#include <gtest/gtest.h>

#include "systems/laws/adhesion.hpp"

namespace pulvis {
namespace {

using kernels::cohesive_damage;
using kernels::CohesiveLaw;

constexpr CohesiveLaw law{4e14, 1e14, 10e6, 8e6, 20, 50, 1.7};

struct Opened {
  double work = 0, spent = 0, largest_n = 0, largest_t = 0, d = 0, shear = 0;
};
// Along one direction until it is broken, by the trapezoidal rule.
Opened open_along(double n, double t) {
  Opened o;
  constexpr int steps = 200'000;
  double t_n = 0, t_t = 0;
  for (int i = 1; i <= steps && o.d < 1; ++i) {
    const double size = 4e-5 * i / steps, step = 4e-5 / steps;
    const auto now = cohesive_damage(law, n * size, t * size, o.d);
    const double new_n = (1 - now.d) * law.k_n * std::max(n, 0.0) * size;
    const double new_t = (1 - now.d) * law.k_t * t * size;
    o.work += 0.5 * ((t_n + new_n) * n + (t_t + new_t) * t) * step;
    t_n = new_n, t_t = new_t;
    o.largest_n = std::max(o.largest_n, t_n), o.largest_t = std::max(o.largest_t, t_t);
    o.spent += now.spent, o.d = now.d, o.shear = now.shear;
  }
  return o;
}

TEST(Bond, OpensAtItsStrengthAndTakesItsFractureEnergy) {
  const Opened o = open_along(1, 0);
  EXPECT_EQ(o.d, 1);
  EXPECT_NEAR(o.largest_n, law.sigma, 1e-3 * law.sigma);
  EXPECT_NEAR(o.work, law.g_i, 1e-3 * law.g_i);
  EXPECT_NEAR(o.spent, law.g_i, 1e-9 * law.g_i);
  EXPECT_EQ(o.shear, 0);
}

TEST(Bond, ShearsOffLikewise) {
  const Opened o = open_along(0, 1);
  EXPECT_NEAR(o.largest_t, law.tau, 1e-3 * law.tau);
  EXPECT_NEAR(o.work, law.g_ii, 1e-3 * law.g_ii);
  EXPECT_NEAR(o.spent, law.g_ii, 1e-9 * law.g_ii);
  EXPECT_EQ(o.shear, 1);
}

TEST(Bond, MixesModesAsBenzeggaghAndKenaneSay) {
  for (const double t : {0.5, 1.0, 2.0, 5.0}) {
    const Opened o = open_along(1, t);
    const double share = law.k_t * t * t / (law.k_n + law.k_t * t * t);
    const double energy = law.g_i + (law.g_ii - law.g_i) * std::pow(share, law.mixed_exponent);
    EXPECT_NEAR(o.shear, share, 1e-12);
    EXPECT_NEAR(o.work, energy, 1e-3 * energy) << t;
    EXPECT_NEAR(o.spent, energy, 1e-9 * energy) << t;
  }
}

TEST(Bond, IsNotDamagedByCompressionAndNeverHeals) {
  EXPECT_EQ(cohesive_damage(law, -1, 0, 0).d, 0);
  const double half_way = 1e-6;
  const auto damaged = cohesive_damage(law, half_way, 0, 0);
  EXPECT_GT(damaged.d, 0);
  EXPECT_LT(damaged.d, 1);
  for (const double less : {0.9, 0.5, 0.0, -3.0}) {
    const auto after = cohesive_damage(law, less * half_way, 0, damaged.d);
    EXPECT_EQ(after.d, damaged.d);
    EXPECT_EQ(after.spent, 0);
  }
}

TEST(Bond, IsUnharmedBelowItsLeastOnset) {
  const double onset = std::min(law.sigma * law.sigma / law.k_n, law.tau * law.tau / law.k_t);
  const double below = std::sqrt(onset * (1 - 1e-12));
  for (const double angle : {0.0, 0.4, 0.8, 1.2, 1.5707963})
    EXPECT_EQ(cohesive_damage(law, below * std::cos(angle) / std::sqrt(law.k_n),
                              below * std::sin(angle) / std::sqrt(law.k_t), 0)
                  .d,
              0)
        << angle;
}

TEST(Adhesion, TakesItsWorkAndIsTheSlopeOfItsEnergy) {
  constexpr double work = 0.3, range = 2e-6, sigma = 2 * work / range;
  EXPECT_NEAR(kernels::adhesion(0.0, sigma, range).energy, -work, 1e-12);
  EXPECT_EQ(kernels::adhesion(-range, sigma, range).energy, 0);
  EXPECT_EQ(kernels::adhesion(-range, sigma, range).traction, 0);
  const double h = 1e-5 * range;
  for (const double g : {-0.9, -0.5, -0.1, 0.2}) {
    const double slope = (kernels::adhesion(g * range + h, sigma, range).energy -
                          kernels::adhesion(g * range - h, sigma, range).energy) /
                         (2 * h);
    EXPECT_NEAR(-slope, kernels::adhesion(g * range, sigma, range).traction, 1e-6 * sigma);
  }
}

}  // namespace
}  // namespace pulvis
