// Of the two friction coefficients that loops on a slope fit, the wedge calibration gives that of the synthetic truth, or
// both.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>

#include "scenes/wedge/wedge_calibration.hpp"
#include "tests/helpers/program.hpp"
#include "tests/helpers/wedge_truth.hpp"

namespace pulvis::wedge {
namespace {

using ::testing::HasSubstr;

// The whole range of friction that does not lock the tip, without noise: the loops decide wherever they can.
TEST(WedgeRoots, FrictionFromAHundredthToThreeComesBackWithoutNoise) {
  for (const double adhesion : {0.0, 12e-9, -10e-9})
    for (const double steep : {14.0, 17.0})
      for (const double mu : {0.01, 0.03, 0.1, 0.3, 0.5, 0.6, 0.7, 0.769, 0.9, 0.98, 1.0, 1.02, 1.1,
                              1.3, 1.7, 2.2, 3.0}) {
        Truth truth;
        truth.friction = mu;
        truth.adhesion = adhesion;
        const Calibration c = calibrate(truth.loops({steep, 0, -12.5}, loads), {});
        const double tolerance =
            mu == 1 ? 1e-6 : 1e-8;  // where the roots meet, round-off is its square root
        EXPECT_NEAR(c.friction.value / mu, 1, tolerance) << mu << ' ' << steep << ' ' << adhesion;
        EXPECT_NEAR(c.sensitivity.value / truth.sensitivity, 1, tolerance) << mu << ' ' << steep;
      }
}

// A single load of known adhesion, without a flat facet: two slopes that differ are enough without noise.
TEST(WedgeRoots, TwoSlopesAtOneLoadDecideWithoutNoise) {
  for (const double mu : {0.01, 0.3, 0.6, 0.8, 1.3, 2.0, 3.0}) {
    Truth truth;
    truth.friction = mu;
    truth.crosstalk = truth.offset = 0;
    std::vector<Loop> all = truth.loops({14, -9, 5}, {80e-9});
    for (Loop& loop : all) loop.half_width_error = loop.offset_error = 1e-6;
    const Calibration c = calibrate(all, {truth.adhesion, 0, 0});
    EXPECT_NEAR(c.friction.value / mu, 1, 1e-6) << mu;
    EXPECT_NEAR(c.sensitivity.value / truth.sensitivity, 1, 1e-6) << mu;
  }
}

struct Tally {
  int right = 0, wrong = 0, undecided = 0, meeting = 0;
  double friction2 = 0,
         sensitivity2 = 0;  // of the errors in units of what is stated, where decided
  int outside = 0;          // beyond three of those, where not decided
};

// Experiments with noise of a share of the largest half-width, and slopes that are off by `tilt`.
Tally tally(double mu, double share, double tilt_degrees, const std::vector<double>& slopes,
            int experiments) {
  Truth truth;
  truth.friction = mu;
  std::mt19937 random(17);
  std::normal_distribution<double> normal(0, 1);
  const double noise = share * truth.loop(14, loads.back()).half_width;
  Tally all;
  for (int e = 0; e < experiments; ++e) {
    std::vector<Loop> loops;
    for (const double slope : slopes) {
      const double real = slope + tilt_degrees * normal(random);
      for (const double load : loads) {
        Loop loop = truth.loop(real, load);
        loop.slope = slope * degree;
        loop.half_width += noise * normal(random);
        loop.offset += noise * normal(random);
        loop.half_width_error = loop.offset_error = noise;
        loops.push_back(loop);
      }
    }
    const Calibration c = calibrate(loops, {0, tilt_degrees * degree, 0});
    const double off = std::abs(c.friction.value - mu) / *c.friction.error;
    if (c.choice == Choice::meeting) {
      ++all.meeting;
      if (off > 3) ++all.outside;
    } else if (c.choice == Choice::undecided) {
      ++all.undecided;
      const double other = std::abs(c.other->friction.value - mu) / *c.other->friction.error;
      if (std::min(off, other) > 3) ++all.outside;
    } else if (off < 3 || std::abs(std::log(c.friction.value / mu)) <
                              std::abs(std::log(c.friction.value * mu))) {
      ++all.right;
      all.friction2 += off * off;
      all.sensitivity2 +=
          std::pow((c.sensitivity.value - truth.sensitivity) / *c.sensitivity.error, 2);
    } else {
      ++all.wrong;
    }
  }
  return all;
}

// The decision is one of three standard deviations: a wrong one in 370. Of 80 experiments at most 2 may be (a
// probability of 0.0013 for more), and never is one wrong without a word where friction can be either.
TEST(WedgeRoots, ADecisionUnderNoiseIsRight) {
  constexpr int experiments = 80;
  for (const double share : {0.001, 0.005})
    for (const double mu : {0.01, 0.1, 0.3, 0.5, 0.7, 0.769, 0.9, 1.0, 1.1, 1.3, 1.7, 2.2, 3.0}) {
      const Tally t = tally(mu, share, 0.1, {14, 0, -12.5}, experiments);
      const std::string what = fmt::format(
          "mu {} noise {}: right {} wrong {} undecided {} meeting {} outside {} mean squares "
          "{:.2f} {:.2f}",
          mu, share, t.right, t.wrong, t.undecided, t.meeting, t.outside, t.friction2 / t.right,
          t.sensitivity2 / t.right);
      EXPECT_LE(t.wrong, 2) << what;
      EXPECT_LE(t.outside, 2) << what;
      if (t.right < experiments / 2) continue;
      EXPECT_LT(t.friction2 / t.right, 1.5) << what;
      EXPECT_LT(t.sensitivity2 / t.right, 1.5) << what;
    }
}

// One slope fits both, whatever the noise: 1.3 must not become 0.769 without a word.
TEST(WedgeRoots, OneSlopeGivesBoth) {
  Truth truth;
  truth.friction = 1.3;
  truth.sensitivity = 137e-9;
  truth.crosstalk = truth.offset = 0;
  std::vector<Loop> one = truth.loops({14}, loads);
  const Calibration c = calibrate(one, {});
  EXPECT_EQ(c.choice, Choice::undecided);
  EXPECT_NEAR(c.friction.value, 1 / truth.friction, 1e-8);
  ASSERT_TRUE(c.other);
  EXPECT_NEAR(c.other->friction.value, truth.friction, 1e-8);
  EXPECT_NEAR(c.other->sensitivity.value / truth.sensitivity, 1, 1e-8);
  Known known;
  known.expected = 1.2;
  const Calibration told = calibrate(one, known);
  EXPECT_EQ(told.choice, Choice::expected);
  EXPECT_NEAR(told.friction.value, truth.friction, 1e-8);
  EXPECT_NEAR(told.other->friction.value, 1 / truth.friction, 1e-8);
  // Not where the loops contradict it.
  known.expected = 0.7;
  EXPECT_NEAR(calibrate(truth.loops({14, 0, -12.5}, loads), known).friction.value, 1.3, 1e-8);
}

TEST(WedgeRoots, AnUpperRootThatLocksTheTipIsNone) {
  Truth truth;
  truth.crosstalk = truth.offset = 0;
  truth.friction = 0.2;  // 5 locks on 14 deg
  const Calibration c = calibrate(truth.loops({14}, loads), {});
  EXPECT_EQ(c.choice, Choice::only);
  EXPECT_FALSE(c.other);
  EXPECT_NEAR(c.friction.value, 0.2, 1e-10);
}

class WedgeProgram : public ProgramTest {
 protected:
  // The summary of `pulvis reduce` with loops of 1.3 and 137 nN/V on these slopes.
  nlohmann::json reduced(const std::vector<double>& slopes, const std::string& more = "") {
    Truth truth;
    truth.friction = 1.3;
    truth.sensitivity = 137e-9;
    std::ofstream file(place / "loops.csv");
    file << "slope [deg],load [nN],half_width [V],offset [V],half_width_error [V],offset_error "
            "[V]\n";
    for (const Loop& loop : truth.loops(slopes, loads))
      file << fmt::format("{},{},{:.9f},{:.9f},0.001,0.001\n", loop.slope / degree, loop.load * 1e9,
                          loop.half_width, loop.offset);
    file.close();
    std::vector<std::string> words{"reduce", "loops.csv", "-o", "done", "--overwrite"};
    if (!more.empty()) words.insert(words.end(), {"--set", more});
    const Outcome outcome = pulvis(words);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    told = outcome.out;
    warned = outcome.err;
    return nlohmann::json::parse(std::ifstream(place / "done" / "summary.json"));
  }
  std::string told, warned;
};

TEST_F(WedgeProgram, FrictionAboveOneIsFoundOrBothRootsAreTold) {
  const auto whole = reduced({14, 0, -12.5});
  EXPECT_NEAR(whole["friction"]["value"], 1.3, 1e-5);
  EXPECT_NEAR(whole["sensitivity"]["value"], 137e-9, 1e-12);
  EXPECT_EQ(whole["root"], "upper");
  EXPECT_EQ(whole["root_by"], "agreement of the loops");
  EXPECT_EQ(warned, "");
  const auto one = reduced({14});
  EXPECT_EQ(one["root_by"], "undecided");
  EXPECT_EQ(one["warnings"].size(), 1U);
  EXPECT_THAT(warned, HasSubstr("warning: the loops fit a friction coefficient of"));
  EXPECT_THAT(told, HasSubstr("or else friction"));
  const double lower = one["friction"]["value"], upper = one["other_root"]["friction"]["value"];
  EXPECT_NEAR(lower * upper, 1, 1e-9);
  const auto expected = reduced({14}, "wedge.expected_friction=1.2");
  EXPECT_EQ(expected["friction"]["value"], upper);
  EXPECT_EQ(warned, "");
}

}  // namespace
}  // namespace pulvis::wedge
