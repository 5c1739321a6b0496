// What a force curve in volts gives: exactly where there is no noise, within its stated uncertainty where there is.
#include "cli/laboratory/volts/force_curve.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/helpers/wrong.hpp"

namespace pulvis::volts {
namespace {

using ::testing::HasSubstr;

constexpr double nm = 1e-9;
const CurveWindow window{0.3, 0.25, 0.95, true};

struct CurveTruth {
  double slope = 0.0125 / nm, touch = 220 * nm, pull = 0.6, tilt = 1e-4 / nm;  // V/m, m, V, V/m
  double crosstalk = 0.03, end = 400 * nm, step = 2 * nm;

  ForceCurve curve(double noise, unsigned seed = 1) const {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal(0, 1);
    ForceCurve made;
    made.name = "1";
    const int steps = static_cast<int>(std::lround(end / step));
    for (int k = 0; k <= 2 * steps; ++k) {
      const bool back = k > steps;
      const double d = step * (back ? 2 * steps - k : k), tension = slope * (d - touch);
      const double y = back ? (tension > -pull ? tension : 0) : std::max(0.0, tension);
      made.displacement.push_back(d);
      made.normal.push_back(0.2 + tilt * d + y + noise * normal(random));
      made.lateral.push_back(-0.1 + crosstalk * y + noise * normal(random));
    }
    made.turn = static_cast<std::size_t>(steps);
    return made;
  }
};

TEST(ForceCurve, WithoutNoiseGivesSlopePullOffAndCrosstalk) {
  const CurveTruth truth;
  const CurveFigures figures = figures_of(truth.curve(0), window);
  EXPECT_NEAR(figures.sensitivity.value / truth.slope, 1, 1e-10);
  EXPECT_NEAR(figures.approach.curvature, 0, 1e-8);
  EXPECT_NEAR(figures.crosstalk->value / truth.crosstalk, 1, 1e-9);
  // The jump lies within the step behind the last sample under tension.
  EXPECT_NEAR(figures.pull_off.value, truth.pull, truth.slope * truth.step / 2 + 1e-12);
  EXPECT_GT(figures.pull_off.error, 0.9 * truth.slope * truth.step / std::sqrt(12.0));
  // A triangle: (pull-off)^2/(2 slope), to what the step cuts off.
  EXPECT_NEAR(figures.work / (truth.pull * truth.pull / (2 * truth.slope)), 1, 0.06);
}

TEST(ForceCurve, StatedUncertaintiesAreThoseThatAreSeen) {
  const CurveTruth truth;
  double slope2 = 0, pull2 = 0, bias = 0, crosstalk2 = 0;
  constexpr int curves = 300;
  for (unsigned i = 0; i < curves; ++i) {
    CurveTruth one = truth;
    one.touch += (i % 10) * 0.2 * nm;  // the jump lies anywhere in its step
    const CurveFigures f = figures_of(one.curve(0.004, i + 1), window);
    slope2 += std::pow((f.sensitivity.value - truth.slope) / f.sensitivity.error, 2) / curves;
    pull2 += std::pow((f.pull_off.value - truth.pull) / f.pull_off.error, 2) / curves;
    crosstalk2 += std::pow((f.crosstalk->value - truth.crosstalk) / f.crosstalk->error, 2) / curves;
    bias += (f.pull_off.value - truth.pull) / curves;
  }
  EXPECT_NEAR(slope2, 0.8, 0.35);  // half the difference of both ways is counted beside the noise
  EXPECT_NEAR(pull2, 0.9, 0.4);
  EXPECT_NEAR(crosstalk2, 0.8, 0.35);
  EXPECT_LT(std::abs(bias), 0.1 * truth.slope * truth.step);
}

TEST(ForceCurve, WithoutAdhesionTheNoiseIsNoPullOff) {
  CurveTruth truth;
  truth.pull = 0;
  const CurveFigures figures = figures_of(truth.curve(0.004), window);
  EXPECT_EQ(figures.pull_off.value, 0);
  EXPECT_NEAR(figures.pull_off.error, 0.004, 0.001);
}

TEST(ForceCurve, TheMeanTakesTheScatterOfCurvesForItsError) {
  std::vector<CurveFigures> figures;
  for (const double factor : {0.98, 1.0, 1.02}) {
    CurveTruth truth;
    truth.slope *= factor;
    figures.push_back(figures_of(truth.curve(0), window));
  }
  const Sensitivity mean = mean_over(figures);
  EXPECT_NEAR(mean.slope.value * nm, 0.0125, 1e-10);
  // 2 % over the root of three, of approach and retract alike; the variance threefold, since three curves say little
  EXPECT_NEAR(mean.slope.error / mean.slope.value, 0.02 / std::sqrt(2.0), 1e-4);
}

// Adhesion holds the probe over the whole retract, or all of it but its last samples: the sign is right.
TEST(ForceCurve, ARetractThatDoesNotComeFreeIsTooShort) {
  for (const double pull : {2.7, 3.0}) {  // 12.5 mV/nm from 220 nm on: free at 4 nm, or never
    CurveTruth truth;
    truth.pull = pull;
    const std::string told =
        message_of<std::runtime_error>([&] { figures_of(truth.curve(0.004), window); });
    EXPECT_THAT(told,
                HasSubstr("does not leave the surface before the range of force_curves.free"));
    EXPECT_THAT(told, HasSubstr("in contact on approach by 12.6 V/um, allowed: a longer retract"));
  }
  // The lines of zero force may differ by drift.
  CurveTruth truth;
  ForceCurve drifting = truth.curve(0.004);
  for (std::size_t i = drifting.turn; i < drifting.normal.size(); ++i)
    drifting.normal[i] += 0.2 * truth.slope * (drifting.displacement[i] - truth.end);
  EXPECT_EQ(message_of<std::runtime_error>([&] { figures_of(drifting, window); }), "");
}

TEST(ForceCurve, WhatIsNoForceCurveIsRefused) {
  const auto message = [](const ForceCurve& curve, const CurveWindow& used = window) {
    return message_of<std::runtime_error>([&] { figures_of(curve, used); });
  };
  CurveTruth truth;
  ForceCurve turned = truth.curve(0.004);
  for (double& v : turned.normal) v = -v;
  EXPECT_THAT(message(turned),
              HasSubstr("allowed: volts that increase where the probe is pressed on"));
  ForceCurve approach = truth.curve(0.004);
  approach.displacement.resize(approach.turn + 1);
  approach.normal.resize(approach.turn + 1);
  EXPECT_THAT(message(approach),
              HasSubstr("without a retract, allowed: an approach and a retract"));
  truth.touch = 500 * nm;  // never reached
  EXPECT_THAT(message(truth.curve(0.004)), HasSubstr("no contact signal above the noise"));
  truth.touch = 220 * nm;
  truth.pull = 2.0;  // would let go at 60 nm, within the part that is taken for free
  EXPECT_THAT(message(truth.curve(0.004)), HasSubstr("allowed"));
  truth.pull = 0.6;
  EXPECT_THAT(message(truth.curve(0.004), {0.02, 0.25, 0.95, true}),
              HasSubstr("samples are free of the surface, allowed: at least 8"));
}

}  // namespace
}  // namespace pulvis::volts
