// Weibull's law by maximum likelihood: a published sample, samples drawn from known laws, factors and limits as
// tabled, and the modulus of several samples.
#include "cli/campaigns/study/analysis/study_weibull.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

namespace pulvis {
namespace {

using Sample = std::vector<double>;

double uniform(std::mt19937_64& engine) {
  return (static_cast<double>(engine() >> 11U) + 0.5) * 0x1p-53;
}

Sample drawn(std::size_t count, double modulus, double scale, std::mt19937_64& engine) {
  Sample sample(count);
  for (double& strength : sample)
    strength = scale * std::pow(-std::log(uniform(engine)), 1 / modulus);
  return sample;
}

// Lives of 23 ball bearings in millions of revolutions (Lieblein & Zelen 1956): shape 2.102 and scale 81.88 (Thoman,
// Bain & Antle 1969; Lawless, Statistical Models and Methods for Lifetime Data).
const Sample bearings{17.88, 28.92, 33.00,  41.52,  42.12,  45.60,  48.48, 51.84,
                      51.96, 54.12, 55.56,  67.80,  68.64,  68.64,  68.88, 84.12,
                      93.12, 98.64, 105.12, 105.84, 127.92, 128.04, 173.40};

TEST(Weibull, FitsTheBallBearingsAsPublished) {
  const WeibullFit fit = fit_weibull({bearings});
  EXPECT_NEAR(fit.modulus.value, 2.102, 5e-4);
  EXPECT_NEAR(fit.scales[0].value, 81.88, 5e-3);
}

// Unbiasing factors of ASTM C1239.
TEST(Weibull, TheBiasIsAsTabled) {
  std::mt19937_64 engine(7);
  for (const auto& [count, factor] : {std::pair{10, 0.859}, {20, 0.931}, {30, 0.955}}) {
    const WeibullFit fit = fit_weibull({drawn(static_cast<std::size_t>(count), 5, 1, engine)});
    EXPECT_NEAR(fit.unbiased_modulus / fit.modulus.value, factor, 0.005) << count;
  }
}

// Of 400 samples of 30 each, limits of 90% confidence hold the truth 360 times, give or take three standard
// deviations of 6.
TEST(Weibull, EstimatesOfDrawnSamplesAreUnbiasedAndTheirLimitsHold) {
  const double modulus = 8, scale = 20e6;
  const int samples = 400;
  std::mt19937_64 engine(3);
  const Sample first = drawn(30, modulus, scale, engine);
  const WeibullFit reference = fit_weibull({first});
  // Limits are the same multiples of the estimates for every sample of 30: no need to draw them each time.
  const double low = reference.modulus.low / reference.modulus.value,
               high = reference.modulus.high / reference.modulus.value;
  const double factor = reference.unbiased_modulus / reference.modulus.value;
  double mean = 0;
  int held = 0, scale_held = 0;
  for (int i = 0; i < samples; ++i) {
    const WeibullFit fit = fit_weibull({drawn(30, modulus, scale, engine)}, 0);
    mean += fit.modulus.value * factor / samples;
    held += fit.modulus.value * low < modulus && modulus < fit.modulus.value * high;
    const auto bound = [&](double reference_bound) {
      return fit.scales[0].value * std::pow(reference_bound / reference.scales[0].value,
                                            reference.modulus.value / fit.modulus.value);
    };
    scale_held += bound(reference.scales[0].low) < scale && scale < bound(reference.scales[0].high);
  }
  EXPECT_NEAR(mean, modulus, 3 * 0.15 * modulus / std::sqrt(samples));
  EXPECT_NEAR(held, 360, 18);
  EXPECT_NEAR(scale_held, 360, 18);
}

TEST(Weibull, ManyStrengthsGiveTheLawBack) {
  std::mt19937_64 engine(1);
  const WeibullFit fit = fit_weibull({drawn(20'000, 12, 3e7, engine)}, 0);
  EXPECT_NEAR(fit.modulus.value, 12, 0.2);
  EXPECT_NEAR(fit.scales[0].value, 3e7, 6e4);
}

// Two sizes of one material: what tells them apart is their scale alone.
TEST(Weibull, SeveralSamplesHaveOneModulus) {
  std::mt19937_64 engine(5);
  const Sample small = drawn(8000, 6, 30e6, engine), large = drawn(4000, 6, 20e6, engine);
  const WeibullFit fit = fit_weibull({small, large}, 0);
  EXPECT_NEAR(fit.modulus.value, 6, 0.15);
  EXPECT_NEAR(fit.scales[0].value, 30e6, 3e5);
  EXPECT_NEAR(fit.scales[1].value, 20e6, 3e5);
  const WeibullFit alone = fit_weibull({small}, 0), twice = fit_weibull({small, small}, 0);
  EXPECT_NEAR(twice.modulus.value, alone.modulus.value, 1e-10 * alone.modulus.value);
}

// Of two sizes with 20 strengths each the limits of the exponent hold the truth in 9 of 10 studies: in 360 of 400, give or
// take three standard deviations.
TEST(Weibull, LimitsOfTheSizeEffectHold) {
  std::mt19937_64 engine(11);
  const std::vector<double> sizes{1, 2};
  const double truth = -0.4, modulus = 5;
  const auto study = [&](int draws) {
    return fit_weibull(
        {drawn(20, modulus, 1, engine), drawn(20, modulus, std::exp2(truth), engine)}, draws,
        sizes);
  };
  const WeibullFit reference = study(default_draws);
  int held = 0;
  for (int i = 0; i < 400; ++i) {
    const WeibullFit fit = study(0);
    // As far from the estimate as in the reference, by the modulus.
    const double scale = reference.modulus.value / fit.modulus.value;
    held +=
        fit.exponent.value + scale * (reference.exponent.low - reference.exponent.value) < truth &&
        truth < fit.exponent.value + scale * (reference.exponent.high - reference.exponent.value);
  }
  EXPECT_NEAR(held, 360, 18);
}

// What a unit, or a power, does to strengths it does to the estimates.
TEST(Weibull, EstimatesFollowUnitsAndPowers) {
  Sample other = bearings;
  for (double& strength : other) strength = 1e6 * strength * strength;
  const WeibullFit fit = fit_weibull({bearings}), changed = fit_weibull({other});
  EXPECT_NEAR(changed.modulus.value, fit.modulus.value / 2, 1e-10);
  EXPECT_NEAR(changed.modulus.low, fit.modulus.low / 2, 1e-10);
  EXPECT_NEAR(std::sqrt(changed.scales[0].low / 1e6), fit.scales[0].low, 1e-8);
  EXPECT_LT(fit.scales[0].low, fit.scales[0].value);
  EXPECT_GT(fit.scales[0].high, fit.scales[0].value);
}

TEST(Weibull, StrengthsStandAtTheMiddleOfTheirShare) {
  EXPECT_DOUBLE_EQ(failure_probability(0, 10), 0.05);
  EXPECT_DOUBLE_EQ(failure_probability(9, 10), 0.95);
}

}  // namespace
}  // namespace pulvis
