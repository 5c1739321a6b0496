// The formulas of the reduction of sliding-plate tests, each against its law.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "cli/laboratory/lab_friction.hpp"
#include "cli/laboratory/lab_stick_slip.hpp"
#include "scenes/solve/lab_fit.hpp"
#include "scenes/solve/lab_statistics.hpp"

namespace pulvis::lab {
namespace {

using ::testing::SizeIs;

// (3.1) and (3.2) forward: r = mu exp(-k mu).
TEST(LabFriction, GivesBackTheCoefficientThatMadeTheForces) {
  for (const double k : {0.0, 0.1, 1.1428, 4.0})
    for (const double mu : {1e-6, 0.05, 0.2, 0.24}) {
      const auto found = friction_coefficient(mu * std::exp(-k * mu), k);
      ASSERT_TRUE(found);
      EXPECT_NEAR(*found, mu, 4e-15) << k;  // k mu < 1: the smaller of the two solutions
    }
}

TEST(LabFriction, IsTheRatioOfTheForcesForAShortCompact) {
  EXPECT_DOUBLE_EQ(*friction_coefficient(0.3, 0), 0.3);
  EXPECT_NEAR(*friction_coefficient(0.3, 1e-9), 0.3 * (1 + 0.3e-9), 1e-16);
}

TEST(LabFriction, EndsWhereNoCoefficientTransmitsMore) {
  const double k = 2, maximum = largest_ratio(k);
  EXPECT_NEAR(*friction_coefficient(maximum * (1 - 1e-12), k), 1 / k, 1e-5);  // a double root
  EXPECT_FALSE(friction_coefficient(maximum * (1 + 1e-9), k));
}

TEST(LabFriction, NoiseAboutZeroKeepsItsSign) {
  EXPECT_NEAR(*friction_coefficient(-0.01 * std::exp(0.01), 1), -0.01, 1e-16);
}

TEST(LabFriction, TheTransmissionOfTheThesisIsThatOfItsCopper) {
  // nu = 0.35, D = 15 mm: exp(-k mu) = 0.61 at its worst needs L mu = 3.44 mm.
  const double k = wall_exponent(0.35 / 0.65, 10e-3, 15e-3);
  EXPECT_NEAR(std::exp(-k * 0.344), 0.61, 0.005);
}

struct Series {
  std::vector<double> t, y;
};

Series bent(double bend, double noise, unsigned seed) {
  std::mt19937 source(seed);
  std::normal_distribution<double> normal(0, 1);
  Series s;
  for (int i = 0; i < 60; ++i) {
    s.t.push_back(1000 + 0.1 * i);
    s.y.push_back(2 + 0.1 * s.t.back() + 1.3 * std::max(0.0, s.t.back() - bend) +
                  noise * normal(source));
  }
  return s;
}

TEST(LabFit, FindsABendBetweenSamplesExactly) {
  for (const double bend : {1002.5, 1002.537, 1003.0}) {
    const Series s = bent(bend, 0, 1);
    EXPECT_NEAR(find_bend(s.t, s.y)->time, bend, 1e-9);  // y is about 100: round-off of 1e-14 / 1.3
  }
}

// The stated uncertainty is the scatter over many records of the same bend, within what 400 tell.
TEST(LabFit, TheUncertaintyIsTheScatter) {
  std::vector<double> times, stated;
  for (unsigned seed = 0; seed < 400; ++seed) {
    const Series s = bent(1002.537, 0.02, seed);
    const auto bend = find_bend(s.t, s.y);
    ASSERT_TRUE(bend && bend->is_significant());
    times.push_back(bend->time);
    stated.push_back(bend->uncertainty);
  }
  const Sample found = sample_of(times);
  EXPECT_NEAR(found.mean, 1002.537, 4 * found.deviation / 20);
  EXPECT_NEAR(sample_of(stated).mean / found.deviation, 1, 0.2);
}

TEST(LabFit, AStraightRecordHasNoBend) {
  Series s = bent(2000, 0.02, 3);  // the bend lies beyond
  const auto bend = find_bend(s.t, s.y);
  EXPECT_FALSE(bend && bend->is_significant());
}

// Two-sided quantiles as every table of Student's distribution has them.
TEST(LabStatistics, StudentsQuantiles) {
  EXPECT_NEAR(student_quantile(0.95, 1), 12.706, 5e-4);
  EXPECT_NEAR(student_quantile(0.95, 2), 4.303, 5e-4);
  EXPECT_NEAR(student_quantile(0.99, 3), 5.841, 5e-4);
  EXPECT_NEAR(student_quantile(0.95, 10), 2.228, 5e-4);
  EXPECT_NEAR(student_quantile(0.95, 29), 2.045, 5e-4);
  EXPECT_NEAR(student_probability(1.0, 2), 1 / std::sqrt(3.0), 1e-14);
}

TEST(LabStatistics, MeanDeviationAndInterval) {
  const Sample sample = sample_of(std::vector<double>{1, 2, 6});
  EXPECT_DOUBLE_EQ(sample.mean, 3);
  EXPECT_DOUBLE_EQ(sample.deviation, std::sqrt(7.0));
  EXPECT_NEAR(*half_width(sample, 0.95), 4.3027 * std::sqrt(7.0 / 3), 1e-3);
  EXPECT_FALSE(half_width(sample_of(std::vector<double>{1}), 0.95));
}

struct Sawtooth {
  std::vector<double> x, t, mu, force;
  // `slipping`: share of the period that a slip takes.
  Sawtooth(double height, double period, double noise, double trend = 0, unsigned seed = 7,
           double slipping = 0) {
    std::mt19937 source(seed);
    std::normal_distribution<double> normal(0, 1);
    for (int i = 0; i < 400; ++i) {
      x.push_back(0.1e-3 * i);
      t.push_back(0.1 * i);
      const double phase = std::fmod(x.back(), period) / period;
      const double tooth = phase < 1 - slipping ? phase / (1 - slipping) : (1 - phase) / slipping;
      mu.push_back(0.2 + trend * x.back() + height * (tooth - 0.5) + noise * normal(source));
      force.push_back(1000 * mu.back());
    }
  }
  std::optional<StickSlip> found(double noise) const {
    return find_stick_slip({x, t, mu, force}, noise);
  }
};

TEST(LabStickSlip, FindsASawtoothToTheStepOfItsSamples) {
  const double height = 0.02, period = 2.37e-3;
  const auto found = Sawtooth(height, period, 0, 0.3).found(0);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->slips, 16u);                     // in 40 mm
  EXPECT_NEAR(found->period, period, 0.1e-3 / 15);  // one sample over all periods
  EXPECT_NEAR(found->period_time, period * 1000, 0.1 / 15);
  EXPECT_NEAR(found->spectral_period, period, 0.01 * period);
  EXPECT_NEAR(found->resolution, height * 0.1e-3 / period,
              0.3 * found->resolution);  // the trend climbs too
  EXPECT_NEAR(found->amplitude, height, 1e-6 * height);
  EXPECT_NEAR(found->force, 1000 * found->amplitude, 2.0);  // the trend is still in the force
}

TEST(LabStickSlip, FindsItInNoise) {
  const auto found = Sawtooth(0.02, 2.37e-3, 0.001).found(0.001);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->period, 2.37e-3, 0.03e-3);
  EXPECT_NEAR(found->amplitude, 0.02, 0.0005);
}

// Noise raises the highest of the samples and lowers the lowest: with 8% of the amplitude, by 15% of it together. The
// lines through the sticks stay: the mean over 12 records is within four of its standard errors, and those are small.
TEST(LabStickSlip, NoiseDoesNotRaiseTheAmplitude) {
  constexpr double height = 0.02;
  for (const double slipping : {0.0, 0.12})
    for (const double share : {0.01, 0.03, 0.08, 0.12}) {
      std::vector<double> amplitudes, forces;
      for (unsigned seed = 1; seed <= 12; ++seed) {
        const auto found =
            Sawtooth(height, 2.37e-3, share * height, 0.1, seed, slipping).found(share * height);
        ASSERT_TRUE(found) << share << ' ' << seed;
        amplitudes.push_back(found->amplitude / height);
        forces.push_back(found->force / (1000 * height));
      }
      // In a slip that takes 2.8 samples, its begin and end are known to half a sample each, of 21 of a stick.
      const double edge = slipping > 0 ? 0.02 : 0;
      for (const auto* figures : {&amplitudes, &forces}) {
        const Sample sample = sample_of(*figures);
        const double error = sample.deviation / std::sqrt(12.0);
        EXPECT_NEAR(sample.mean, 1, 4 * error + edge + 1e-6) << share << ' ' << slipping;
        EXPECT_LT(error, 0.1 * share + 0.002) << share << ' ' << slipping;
      }
    }
}

TEST(LabStickSlip, RandomFluctuationIsNone) {
  EXPECT_FALSE(Sawtooth(0, 1e-3, 0.001).found(0.001));
  EXPECT_FALSE(Sawtooth(0, 1e-3, 0.02).found(0.001));  // rougher sliding than standstill told
  EXPECT_FALSE(Sawtooth(0, 1e-3, 0, 0.5).found(0));
}

TEST(LabStickSlip, TurningPointsAlternateAndIgnoreSmallOnes) {
  const std::vector<double> y{0, 3, 2.8, 3.1, 0, 0.2, -0.1, 5, 5};
  const auto points = turning_points(y, 1);
  ASSERT_THAT(points, SizeIs(3));
  EXPECT_EQ(points[0].at, 0u);
  EXPECT_EQ(points[1].at, 3u);
  EXPECT_TRUE(points[1].is_peak);
  EXPECT_EQ(points[2].at, 6u);
}

TEST(LabStickSlip, TheSpectrumFindsASineBetweenUnevenSamples) {
  std::mt19937 source(3);
  std::uniform_real_distribution<double> uniform(0.5, 1.5);
  std::vector<double> x{0}, y;
  while (x.size() < 300) x.push_back(x.back() + 0.1 * uniform(source));
  for (const double at : x) y.push_back(std::sin(2 * std::numbers::pi * at / 1.7 + 0.4));
  EXPECT_NEAR(spectral_period(x, y), 1.7, 0.02 * 1.7);
}

}  // namespace
}  // namespace pulvis::lab
