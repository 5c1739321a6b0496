// Strength against porosity: the law's parameters come back, and scatter shows in r^2.
#include "cli/campaigns/study/analysis/study_porosity.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace pulvis {
namespace {

TEST(Porosity, GivesTheParametersBack) {
  std::vector<double> porosity, strength;
  for (const double p : {0.05, 0.08, 0.2, 0.11, 0.3}) {
    porosity.push_back(p);
    strength.push_back(250e6 * std::exp(-7 * p));
  }
  const PorosityFit fit = fit_porosity(porosity, strength);
  EXPECT_NEAR(fit.dense_strength, 250e6, 1e-3);
  EXPECT_NEAR(fit.k, 7, 1e-10);
  EXPECT_NEAR(fit.r_squared, 1, 1e-12);
}

// ln(strength) is 1, 3, 2 at porosities 0, 1, 2: slope 1/2, mean 2, and a quarter of the variance explained.
TEST(Porosity, ScatterIsInRSquared) {
  const PorosityFit fit = fit_porosity({0, 1, 2}, {std::exp(1), std::exp(3), std::exp(2)});
  EXPECT_NEAR(fit.k, -0.5, 1e-12);
  EXPECT_NEAR(std::log(fit.dense_strength), 1.5, 1e-12);
  EXPECT_NEAR(fit.r_squared, 0.25, 1e-12);
}

}  // namespace
}  // namespace pulvis
