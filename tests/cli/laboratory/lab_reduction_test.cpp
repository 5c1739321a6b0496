// The reduction of a test whose truth is known gives that truth back: to round-off without noise, within
// the noise with it.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/helpers/sliding_test.hpp"
#include "tests/helpers/wrong.hpp"

namespace pulvis::lab {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST(LabReduction, WithoutNoiseEverySampleIsExact) {
  const SlidingTest truth;
  const ReducedRun run = reduced(truth);
  ASSERT_GT(run.curve.time.size(), 380u);
  for (std::size_t i = 0; i < run.curve.time.size(); ++i) {
    const double x = truth.speed * run.curve.time[i];
    EXPECT_NEAR(run.curve.distance[i], x, 1e-12);
    EXPECT_NEAR(run.curve.friction[i], truth.friction(x), 1e-9) << x;  // 1e-12 m times 0.44 / mm
    EXPECT_NEAR(run.curve.target_force[i] * run.curve.friction[i], run.curve.shear_force[i], 1e-9);
  }
}

// The punch displacement has a kink where sliding starts. Where that lies between two samples of the
// press, 0.4 of the way, the line between them is off by slope x interval x 0.4 x 0.6 = 4.7e-8 m, and
// with it the length that all later travel is counted from: 4.7 / m in the coefficient.
TEST(LabReduction, WithoutNoiseAKinkBetweenSamplesCostsWhatLinesBetweenThemCost) {
  SlidingTest truth;
  truth.press_start = 23.37;
  const double kink = truth.settling * truth.speed * 0.05 * 0.4 * 0.6;
  EXPECT_NEAR(reduced(truth).dynamic.mean, truth.level, 4.7 * kink);
}

TEST(LabReduction, WithoutNoiseClocksAndFiguresAreExact) {
  const SlidingTest truth;
  const ReducedRun run = reduced(truth);
  EXPECT_NEAR(run.clocks.offset, truth.press_start - truth.logger_start, 1e-9);
  EXPECT_NEAR(*run.clocks.drift, 0, 1e-9);
  EXPECT_NEAR(run.dynamic.mean, truth.level, 1e-9);
  EXPECT_NEAR(run.dynamic.trend, 0, 1e-6);
  EXPECT_NEAR(run.speed, truth.speed, 3e-3 * truth.speed);  // the last sample is before the end
  const double step = truth.speed * 0.1, fall = (truth.peak - truth.level) / 3.48e-3;
  EXPECT_LE(run.peak.value, truth.peak);
  EXPECT_GE(run.peak.value, truth.peak - fall * step);  // the sample after the peak at the worst
  EXPECT_TRUE(run.peak.is_distinct);
  EXPECT_FALSE(run.stick_slip);
}

TEST(LabReduction, ADriftOfTheClocksIsFoundAndTakenOut) {
  SlidingTest truth;
  truth.drift = 8e-4;
  const ReducedRun run = reduced(truth);
  EXPECT_TRUE(run.clocks.is_drift_applied);
  EXPECT_NEAR(*run.clocks.drift, truth.drift, 1e-9);
  EXPECT_NEAR(run.clocks.press_time(truth.logger_time(50)), 50, 1e-6);
}

// Clocks that run alike: what noise shows as drift stays unapplied, and the offset's uncertainty is
// what it says. Chance: 20 records, errors within 3.5 of the stated deviations.
TEST(LabReduction, TheOffsetIsWithinItsUncertainty) {
  double squares = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    SlidingTest truth;
    truth.noise = 1;
    truth.seed = seed;
    const ReducedRun run = reduced(truth);
    const double error = run.clocks.offset - (truth.press_start - truth.logger_start);
    const double ratio = error / run.clocks.offset_uncertainty;
    EXPECT_LT(std::abs(ratio), 3.5) << seed;
    EXPECT_LT(run.clocks.offset_uncertainty, 0.15) << seed;
    squares += ratio * ratio / 20;
  }
  EXPECT_LT(squares, 2.0);  // 1 for Gauss; chi squared of 20: 2.0 is the 0.5 % point
}

TEST(LabReduction, NoiseOfTheSensorsMovesTheFiguresByLessThanItself) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    SlidingTest truth;
    truth.noise = 1;
    truth.seed = seed;
    truth.slip_height = 0.014;
    const ReducedRun run = reduced(truth);
    const double noise = 0.73 / 810 * 1.3;  // of the coefficient: load cell over target force
    EXPECT_NEAR(run.noise, noise, 0.35 * noise);
    // Mean over 300 samples; a part of a tooth at the end counts height / 2 * period / 40 mm / 4.
    EXPECT_NEAR(run.dynamic.mean, truth.level, 4 * noise / std::sqrt(300.0) + 1e-4);
    EXPECT_NEAR(run.peak.value, truth.peak, 0.0019 + 3 * noise);  // step of a sample, noise
    ASSERT_TRUE(run.stick_slip);
    EXPECT_NEAR(run.stick_slip->period, truth.slip_period, 0.02 * truth.slip_period);
    EXPECT_NEAR(run.stick_slip->amplitude, truth.slip_height,
                run.stick_slip->resolution + 2 * noise);
  }
}

TEST(LabReduction, AGivenOffsetNeedsNoEvent) {
  SlidingTest truth;
  truth.settling = 0;  // the punch does not see the plate move
  EXPECT_THAT(message_of([&] { reduced(truth); }),
              StartsWith("press.csv:1:1: clock: the punch displacement does not show where sliding "
                         "starts, allowed: "));
  const ReducedRun run = reduced(truth, {}, truth.press_start - truth.logger_start);
  EXPECT_TRUE(run.clocks.is_given);
  EXPECT_NEAR(run.dynamic.mean, truth.level, 1e-9);
}

TEST(LabReduction, AWallCoefficientOfItsOwnStandsInTheTransmission) {
  const SlidingTest truth;
  const ReducedRun run = reduced(truth, {"compact.wall_friction=0.1"});
  const std::size_t i = 200;
  const Curve& c = run.curve;
  const double k = wall_exponent(0.3 / 0.7, c.length[i], 15e-3);
  EXPECT_NEAR(c.target_force[i], c.punch_force[i] * std::exp(-0.1 * k), 1e-9);
  EXPECT_NEAR(c.friction[i], c.shear_force[i] / c.target_force[i], 1e-15);
}

// A compact whose radial stress is 0.65 of the axial one: with that K its coefficient comes back, with the elastic one too
// small a coefficient does.
TEST(LabReduction, AStressRatioOfItsOwnStandsInTheTransmission) {
  SlidingTest truth;
  truth.stress_ratio = 0.65;
  const ReducedRun run = reduced(truth, {"compact.stress_ratio=0.65"});
  EXPECT_NEAR(run.dynamic.mean, truth.level, 1e-9);
  ASSERT_TRUE(run.elastic_dynamic);
  const ReducedRun elastic = reduced(truth);
  EXPECT_DOUBLE_EQ(*run.elastic_dynamic, elastic.dynamic.mean);
  EXPECT_LT(elastic.dynamic.mean, 0.99 * truth.level);
  EXPECT_FALSE(elastic.elastic_dynamic);
}

TEST(LabReduction, TheFillHeightGivesTheSameLength) {
  const SlidingTest truth;
  const double height = truth.length + truth.punch(truth.press_start);
  const Settings settings =
      load_settings_text(
          "", "reduce.toml",
          {fmt::format("compact.fill_height={:.17g} m", height), "compact.poissons_ratio=0.3"})
          .settings;
  const ReducedRun run = reduce(truth.press(), truth.logger(), settings, {"r", "p", "l", {}});
  EXPECT_NEAR(run.dynamic.mean, truth.level, 1e-9);
}

TEST(LabReduction, AZeroTakenAtStandstillTakesOutALoadCellThatCreptAway) {
  const SlidingTest truth;
  LoggerRecord logger = truth.logger();
  for (double& strain : logger.strain) strain += 20e-6;  // 14.5 N
  const Settings settings = settings_of({"load_cell.zero=standstill"});
  const ReducedRun run = reduce(truth.press(), logger, settings, {"r", "p", "l", {}});
  EXPECT_NEAR(run.shear_zero, 20e-6 * 0.7257e6, 1e-9);
  EXPECT_NEAR(run.dynamic.mean, truth.level, 1e-9);
}

TEST(LabReduction, RunsAreAveragedOnACommonGrid) {
  std::vector<ReducedRun> runs;
  for (const double level : {0.17, 0.18, 0.2}) {
    SlidingTest truth;
    truth.level = level;
    truth.distance = level == 0.18 ? 40e-3 : 50e-3;
    runs.push_back(reduced(truth));
  }
  const Repeatability over = repeatability(runs, 1e-4);
  EXPECT_NEAR(over.dynamic.mean, 0.55 / 3, 1e-9);
  EXPECT_NEAR(over.dynamic.deviation,
              std::sqrt((0.17 * 0.17 + 0.18 * 0.18 + 0.04 - 0.55 * 0.55 / 3) / 2), 1e-9);
  EXPECT_NEAR(static_cast<double>(over.friction.size()), 400, 2);  // as far as the shortest goes
  EXPECT_NEAR(over.friction[200].mean, 0.55 / 3, 1e-9);
}

// ---- what is refused

// The plate stops and the load cell lets go: one sample after it or forty, none of them is of sliding.
TEST(LabReduction, NoSampleOfAPlateAtRestCounts) {
  for (const double start : {6.21, 6.2, 6.25, 6.299})
    for (const int after : {0, 1, 2, 3, 4, 6, 12, 40}) {
      SlidingTest truth;
      truth.logger_start = start;
      LoggerRecord logger = truth.logger();
      const double end = start + truth.lasts();
      std::size_t kept = 0;
      for (std::size_t i = 0; i < logger.time.size(); ++i) {
        if (logger.time[i] >= end) logger.strain[i] = -1.3795 / 0.7257e6;
        if (logger.time[i] <= end + 1e-9 + 0.1 * after) kept = i + 1;
      }
      for (auto* column : {&logger.time, &logger.strain, &logger.lvdt}) column->resize(kept);
      logger.lines.resize(kept);
      const ReducedRun run = reduce(truth.press(), logger, settings_of(), {"run-1", "p", "l", {}});
      EXPECT_NEAR(run.dynamic.mean, truth.level, 1e-6) << start << " " << after;
      EXPECT_GT(run.curve.friction.back(), 0.9 * truth.level) << start << " " << after;
      EXPECT_GT(run.curve.distance.back(), truth.distance - 3 * 0.1 * truth.speed);
    }
}

TEST(LabReduction, RefusesATooShortDistance) {
  SlidingTest truth;
  truth.distance = 9e-3;
  EXPECT_THAT(message_of([&] { reduced(truth); }),
              StartsWith("logger.csv:1:1: lvdt: the plate slides 9 mm, allowed: at least 15 mm"));
  EXPECT_THAT(message_of([&] { reduced(truth, {"analysis.shortest_sliding=5 mm"}); }),
              HasSubstr("with 0 samples for the dynamic mean, allowed: at least 20"));
}

TEST(LabReduction, RefusesAStaticCoefficientWithoutASample) {
  EXPECT_THAT(message_of([] { reduced(SlidingTest{}, {"analysis.static_within=0.00001 mm"}); }),
              HasSubstr("no sample lies within 1e-05 mm of the start (analysis.static_within)"));
}

TEST(LabReduction, RefusesRecordsOfDifferentTests) {
  SlidingTest press, logger;
  logger.speed = 0.7e-3;  // slides for 71 s; the press held its force for 66 s
  const auto reduce_both = [&] {
    reduce(press.press(), logger.logger(), settings_of(), {"r", "p", "l", {}});
  };
  EXPECT_THAT(message_of(reduce_both), HasSubstr("allowed: records of one test, which overlap"));
  logger.speed = 1.25e-3;  // 40 s against 38.5 s: within the window of the end
  EXPECT_THAT(message_of(reduce_both),
              HasSubstr("allowed: records of one test, whose clocks differ"));
}

TEST(LabReduction, RefusesAnOffsetThatLeavesTheHeldForce) {
  EXPECT_THAT(message_of([] { reduced({}, {}, 100.0); }), HasSubstr("sliding lies at 106.21 to"));
}

TEST(LabReduction, RefusesALoggerThatWasSwitchedOnTooLate) {
  SlidingTest truth;
  truth.logger_start = 0.2;
  EXPECT_THAT(message_of([&] { reduced(truth); }),
              StartsWith("logger.csv:1:1: lvdt: no start of sliding is found, allowed: "));
}

TEST(LabReduction, RefusesAShearForceThatNoCoefficientGives) {
  SlidingTest truth;
  LoggerRecord logger = truth.logger();
  logger.strain[200] = 600e-6;  // 435 N of 1000 N: 1/(e k) is 0.32
  EXPECT_THAT(message_of([&] {
                reduce(truth.press(), logger, settings_of(), {"r", "p", "l", {}});
              }),
              StartsWith("logger.csv:202:1: strain: the shear force is 0.43"));
}

TEST(LabReduction, RefusesALoadCellOfTheOtherSign) {
  EXPECT_THAT(message_of([] { reduced({}, {"load_cell.gain=-0.7257 N/(um/m)"}); }),
              HasSubstr("load_cell.gain of the opposite sign"));
}

}  // namespace
}  // namespace pulvis::lab
