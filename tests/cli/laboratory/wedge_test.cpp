// The wedge calibration gives back the truth of synthetic loops: exactly without noise, within the uncertainty
// that it states with it.
#include "scenes/wedge/wedge_calibration.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>

#include "cli/laboratory/wedge_records.hpp"
#include "scenes/lever/afm_loop.hpp"
#include "tests/helpers/wedge_truth.hpp"
#include "tests/helpers/wrong.hpp"

namespace pulvis::wedge {
namespace {

using ::testing::HasSubstr;

TEST(WedgeCalibration, SeveralLoadsGiveFrictionSensitivityAndAdhesionWithoutNoise) {
  const Truth truth;
  const Calibration c = calibrate(truth.loops({14, 0, -12.5}, loads), {});
  EXPECT_NEAR(c.friction.value, truth.friction, 1e-10);
  EXPECT_NEAR(c.sensitivity.value / truth.sensitivity, 1, 1e-10);
  EXPECT_NEAR(c.crosstalk->value / truth.crosstalk, 1, 1e-9);
  EXPECT_NEAR(*c.flat_friction, truth.friction, 1e-10);
  ASSERT_EQ(c.facets.size(), 3u);
  for (const Facet& facet : c.facets)
    EXPECT_NEAR(facet.adhesion->value / truth.adhesion, 1, 1e-8) << facet.slope;
}

TEST(WedgeCalibration, OneLoadIsEnoughWhereAdhesionIsKnown) {
  Truth truth;
  truth.crosstalk = truth.offset = 0;
  const Calibration c = calibrate(truth.loops({-12.5}, {80e-9}), {truth.adhesion, 0, 0});
  EXPECT_NEAR(c.friction.value, truth.friction, 1e-10);
  EXPECT_NEAR(c.sensitivity.value / truth.sensitivity, 1, 1e-10);
  EXPECT_FALSE(c.friction.error);
}

// Five hundred experiments: the errors, in units of what was stated for them, have a mean square of one.
TEST(WedgeCalibration, StatedUncertaintiesAreThoseThatAreSeen) {
  Truth truth;
  std::mt19937 random(7);
  constexpr double noise = 2e-4;  // V
  std::normal_distribution<double> normal(0, noise);
  double friction2 = 0, sensitivity2 = 0;
  constexpr int experiments = 500;
  for (int e = 0; e < experiments; ++e) {
    auto loops = truth.loops({14, 0, -12.5}, loads);
    for (Loop& loop : loops) {
      loop.half_width += normal(random);
      loop.offset += normal(random);
      loop.half_width_error = loop.offset_error = noise;
    }
    const Calibration c = calibrate(loops, {});
    friction2 += std::pow((c.friction.value - truth.friction) / *c.friction.error, 2);
    sensitivity2 += std::pow((c.sensitivity.value - truth.sensitivity) / *c.sensitivity.error, 2);
  }
  // The larger of two errors is stated, so the squares are rather smaller than one.
  EXPECT_NEAR(friction2 / experiments, 0.8, 0.3);
  EXPECT_NEAR(sensitivity2 / experiments, 0.8, 0.3);
}

// A constant offset of the detector counts once per load in the mean of one load, and not at all in a slope.
TEST(WedgeCalibration, AnOffsetOfTheDetectorIsNoCrosstalkWhereTheFlatFacetHasOneLoad) {
  const Truth truth;
  std::vector<Loop> all = truth.loops({14, -12.5}, loads);
  all.push_back(truth.loop(0, loads[1]));
  const Calibration c = calibrate(all, {});
  EXPECT_NEAR(c.friction.value, truth.friction, 1e-9);
  EXPECT_NEAR(c.sensitivity.value / truth.sensitivity, 1, 1e-9);
  EXPECT_NEAR(c.crosstalk->value / truth.crosstalk, 1, 1e-8);
  for (const Facet& facet : c.facets) {
    if (facet.slope == 0) continue;
    const double s = std::sin(facet.slope), k = std::cos(facet.slope),
                 mu2 = std::pow(truth.friction, 2);
    const double by_load = (1 + mu2) * s * k / (k * k - mu2 * s * s) / truth.sensitivity;
    EXPECT_NEAR(facet.offset.value / by_load, 1, 1e-8);
  }
}

TEST(WedgeCalibration, AnOffsetOfTheDetectorIsKnownWhereTheFlatFacetHasSeveralLoads) {
  const Truth truth;
  std::vector<Loop> all = truth.loops({0}, loads);
  all.push_back(truth.loop(14, loads[2]));
  all.push_back(truth.loop(-12.5, loads[1]));
  const Calibration c = calibrate(all, {truth.adhesion, 0, 0});
  EXPECT_NEAR(c.friction.value, truth.friction, 1e-9);
  EXPECT_NEAR(c.sensitivity.value / truth.sensitivity, 1, 1e-9);
}

TEST(WedgeCalibration, OneLoadOnEveryFacetMustBeTheSame) {
  const Truth truth;
  const Known known{truth.adhesion, 0, 0};
  const Calibration c = calibrate(truth.loops({0, 14, -12.5}, {80e-9}), known);
  EXPECT_NEAR(c.friction.value, truth.friction, 1e-9);
  EXPECT_THAT(message_of<std::runtime_error>([&] {
                calibrate({truth.loop(0, 50e-9), truth.loop(14, 80e-9)}, known);
              }),
              HasSubstr("50 nN only and the slope of 14 deg at 80 nN only"));
}

// The loops of slopes that differ from the stated ones, the flat facet's among them, by a known standard uncertainty.
void expect_seen_errors(const std::vector<double>& slopes, const std::vector<double>& flat_loads) {
  const Truth truth;
  constexpr double tilt = 0.2;  // deg
  std::mt19937 random(5);
  std::normal_distribution<double> normal(0, tilt);
  double friction2 = 0, sensitivity2 = 0, crosstalk2 = 0;
  constexpr int experiments = 2000;
  for (int e = 0; e < experiments; ++e) {
    std::vector<Loop> all;
    for (const double slope : slopes) {
      const double real = slope + normal(random);
      for (const double load : slope == 0 ? flat_loads : loads) {
        all.push_back(truth.loop(real, load));
        all.back().slope = slope * degree;
        all.back().half_width_error = all.back().offset_error = 1e-9;
      }
    }
    const Calibration c = calibrate(all, {truth.adhesion, tilt * degree, 0});
    friction2 += std::pow((c.friction.value - truth.friction) / *c.friction.error, 2);
    sensitivity2 += std::pow((c.sensitivity.value - truth.sensitivity) / *c.sensitivity.error, 2);
    crosstalk2 += std::pow((c.crosstalk->value - truth.crosstalk) / *c.crosstalk->error, 2);
  }
  EXPECT_NEAR(friction2 / experiments, 1, 0.15);
  EXPECT_NEAR(sensitivity2 / experiments, 1, 0.15);
  EXPECT_NEAR(crosstalk2 / experiments, 1, 0.15);
}

TEST(WedgeCalibration, TheSlopeErrorOfTheFlatFacetIsAmongTheUncertainties) {
  expect_seen_errors({0, 14}, loads);
}
TEST(WedgeCalibration, TheSlopeErrorOfAFlatFacetWithOneLoadIsAmongTheUncertainties) {
  expect_seen_errors({0, 14}, {loads[2]});
}

TEST(WedgeCalibration, WhatFitsNoFrictionIsRefused) {
  const auto message = [](const std::vector<Loop>& loops) -> std::string {
    return message_of<std::runtime_error>([&] { calibrate(loops, {}); });
  };
  EXPECT_THAT(message({{14 * degree, 1e-7, 0.1, 0.01, {}, {}}}), HasSubstr("allowed: >= 2"));
  EXPECT_THAT(message({{0, 1e-7, 0.1, 0.01, {}, {}}}), HasSubstr("no facet with a slope"));
  EXPECT_THAT(message({{14 * degree, 1e-7, 0, 0.01, {}, {}}}), HasSubstr("no width"));
}

// Raw traces as an instrument writes them, with noise of neighbours that go together, and the tip sticking where
// it has turned.
TEST(WedgeRecords, RawTracesGiveTheTruthBackWithinTheStatedUncertainty) {
  const Truth truth;
  const auto file = std::filesystem::temp_directory_path() / "pulvis-wedge-traces.csv";
  std::mt19937 random(11);
  std::normal_distribution<double> normal(0, 0.004);
  {
    std::ofstream out(file);
    out << "slope [deg],load [nN],position [nm],trace [V],retrace [V]\n";
    constexpr int places = 256;
    for (const double slope : {14.0, 0.0, -12.5})
      for (const double load : loads) {
        const Loop loop = truth.loop(slope, load);
        double drift_trace = 0, drift_retrace = 0;
        for (int i = 0; i < places; ++i) {
          drift_trace = 0.7 * drift_trace + normal(random);
          drift_retrace = 0.7 * drift_retrace + normal(random);
          const double stick = std::exp(-i / 6.0);
          const double stick_back = std::exp(-(places - 1 - i) / 6.0);
          out << fmt::format("{},{},{},{:.6f},{:.6f}\n", slope, load * 1e9, i,
                             loop.offset + loop.half_width * (1 - 2 * stick) + drift_trace,
                             loop.offset - loop.half_width * (1 - 2 * stick_back) + drift_retrace);
        }
      }
  }
  EXPECT_TRUE(holds_loops(file));
  const Calibration c = calibrate(read_loops(file, 0.15), {});
  std::filesystem::remove(file);
  EXPECT_LT(*c.friction.error, 0.05 * truth.friction);
  EXPECT_LT(std::abs(c.friction.value - truth.friction), 3 * *c.friction.error);
  EXPECT_LT(std::abs(c.sensitivity.value - truth.sensitivity), 3 * *c.sensitivity.error);
}

// Three times the same loop, one after the other: three loops, each as if it were alone.
TEST(WedgeRecords, ARepetitionBeginsWhereThePositionReturns) {
  const auto file = std::filesystem::temp_directory_path() /
                    ("pulvis-repetitions-" + std::to_string(getpid()) + ".csv");
  const Truth truth;
  const Loop loop = truth.loop(14, loads[0]);
  constexpr int places = 64;
  const auto written = [&](int repetitions, const char* unit, double sign) {
    std::ofstream out(file);
    out << "slope [deg],load [nN],position [" << unit << "],trace [V],retrace [V]\n";
    for (int r = 0; r < repetitions; ++r)
      for (int i = 0; i < places; ++i) {
        const double place = sign * (i + 2 * (i % 2));  // with the noise of a position sensor
        const double stick = 1 - 2 * std::exp(-i / 2.0),
                     back = 1 - 2 * std::exp((i - places + 1) / 2.0);
        out << fmt::format("14,{},{},{:.9f},{:.9f}\n", loads[0] * 1e9, place,
                           loop.offset + loop.half_width * stick,
                           loop.offset - loop.half_width * back);
      }
  };
  written(1, "nm", 1);
  const std::vector<Loop> once = read_loops(file, 0.15);
  ASSERT_EQ(once.size(), 1u);
  for (const double sign : {1.0, -1.0}) {
    written(3, "nm", sign);
    const std::vector<Loop> thrice = read_loops(file, 0.15);
    ASSERT_EQ(thrice.size(), 3u);
    for (const Loop& one : thrice) {
      EXPECT_EQ(one.half_width, once.front().half_width);
      EXPECT_EQ(one.offset, once.front().offset);
    }
    EXPECT_NEAR(once.front().half_width / loop.half_width, 1, 0.01);
  }
  written(1, "xyz", 1);
  EXPECT_THAT(message_of([&] { read_loops(file, 0.15); }), HasSubstr("position"));
  std::filesystem::remove(file);
}

// Recognised by the columns that are right, and refused for those that are wrong.
TEST(WedgeRecords, WithAMisspeltColumnAreStillLoops) {
  const auto file = std::filesystem::temp_directory_path() /
                    ("pulvis-loops-" + std::to_string(getpid()) + ".csv");
  const auto refusal = [&](const char* header) {
    std::ofstream(file) << header << "\n14,20,0.1,0.2\n";
    EXPECT_TRUE(holds_loops(file)) << header;
    return message_of([&] { read_loops(file, 0.1); });
  };
  EXPECT_THAT(refusal("slop [deg],load [nN],trace [V],retrace [V]"),
              HasSubstr("slop: the column is unknown, allowed: slope, load"));
  EXPECT_THAT(refusal("slope [deg],load [nN],trace [V],retrce [V]"),
              HasSubstr("retrce: the column is unknown, allowed: slope, load"));
  EXPECT_THAT(refusal("slope [deg],load [nN],half_with [V],offset [V]"),
              HasSubstr("half_with: the column is unknown, allowed: slope, load, half_width"));
  std::ofstream(file) << "time [s],load [N]\n0,1\n";
  EXPECT_FALSE(holds_loops(file));
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace pulvis::wedge
