// Laws fitted across the runs of a study: what a run's history becomes, what keeps a group from being fitted, and the
// size effect of the weakest link.
#include "cli/campaigns/study/analysis/study_fits.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "cli/campaigns/study/analysis/study_power.hpp"
#include "cli/campaigns/study/analysis/study_weibull.hpp"

namespace pulvis {
namespace {

using ::testing::HasSubstr;

class StudyFits : public ::testing::Test {
 protected:
  // Discs whose i-th of n strengths stands where a law of modulus 6 has its probability.
  void add_discs(const std::string& variation, double diameter, double scale) {
    for (std::size_t i = 0; i < count; ++i) {
      StudyRun run;
      run.variation = variation;
      run.name = variation + std::to_string(i);
      run.scene.thickness = 2e-3;
      ParticleSpec disc;
      disc.name = "disc";
      disc.outline = DiscOutline{diameter};
      run.scene.particles = {disc};
      ToolSpec top;
      top.name = "top";
      run.scene.tools = {top};
      study.runs.push_back(run);
      const double p = failure_probability(count - 1 - i, count);
      const double strength = scale * std::pow(-std::log(1 - p), 1 / modulus);
      forces.push_back(strength * std::numbers::pi * diameter * 2e-3 / 2);
    }
  }

  FittedLaw fitted(const std::string& failing = "") {
    StudyFit fit;
    fit.series = "tool/top/force_y";
    fit.when = StudyFit::When::max;
    fit.against = "time";
    fit.disc = "disc";
    study.spec.fits = {fit};
    const auto series = [&](const StudyRun& run, const std::string& name) {
      const double force = forces[static_cast<std::size_t>(&run - study.runs.data())];
      return name == "time" ? std::vector<double>{0, 1, 2} : std::vector<double>{-1, force, -1};
    };
    const auto failed = [&](const StudyRun& run) {
      return run.name == failing ? std::string("it crashed") : std::string();
    };
    return fit_study(study, series, failed).at(0);
  }

  Study study;
  std::vector<double> forces;
  static constexpr std::size_t count = 40;
  static constexpr double modulus = 6;
};

TEST_F(StudyFits, ForcesBecomeNominalStrengthsInRisingOrder) {
  add_discs("small", 0.01, 20e6);
  const FittedLaw law = fitted();
  EXPECT_EQ(law.unit, "Pa");
  const FittedGroup& group = law.groups.at(0);
  EXPECT_EQ(group.not_fitted, "");
  EXPECT_EQ(group.diameter, 0.01);
  EXPECT_EQ(group.points.front().run->name, "small39");
  EXPECT_NEAR(group.points.front().strength, 20e6 * std::pow(-std::log(1 - 0.5 / 40), 1.0 / 6), 1);
  EXPECT_NEAR(group.parameters[0].value, modulus, 0.15);
  EXPECT_NEAR(group.parameters[2].value, 20e6, 2e5);
  EXPECT_TRUE(law.size_effect.empty());
}

// Scales that follow the weakest link, twice the diameter with 2^(-2/6) of the strength.
TEST_F(StudyFits, TheWeakestLinkIsFound) {
  add_discs("small", 0.01, 20e6);
  add_discs("large", 0.02, 20e6 * std::pow(2.0, -2 / modulus));
  const FittedLaw law = fitted();
  ASSERT_EQ(law.size_effect.size(), 3U);
  EXPECT_EQ(law.size_effect[0].name, "common_modulus");
  EXPECT_NEAR(law.size_effect[0].value, law.groups[0].parameters[0].value, 1e-9);
  EXPECT_DOUBLE_EQ(law.size_effect[1].value, -2 / law.size_effect[0].value);
  EXPECT_DOUBLE_EQ(law.size_effect[1].low.value(), -2 / law.size_effect[0].low.value());
  EXPECT_NEAR(law.size_effect[2].value, -2 / modulus, 1e-9);
  EXPECT_LT(law.size_effect[2].low.value(), -2 / modulus);
  EXPECT_GT(law.size_effect[2].high.value(), -2 / modulus);
}

TEST_F(StudyFits, WhatFailedOrIsNoStrengthIsTold) {
  add_discs("small", 0.01, 20e6);
  add_discs("large", 0.02, 20e6);
  const FittedLaw law = fitted("large7");
  EXPECT_THAT(law.groups[1].not_fitted, HasSubstr("no result of large7: it crashed"));
  EXPECT_TRUE(law.groups[1].parameters.empty());
  EXPECT_TRUE(law.size_effect.empty());
  EXPECT_EQ(law.groups[0].not_fitted, "");
  forces[3] = -2;
  EXPECT_THAT(fitted().groups[0].not_fitted, HasSubstr("of small3 is not a strength"));
}

// Of a key's exact power law every exponent is that power, over all runs and at each; the unit is that of the key.
TEST(StudyPower, ExponentsOfAnExactLaw) {
  const std::vector<double> key{1e-6, 2e-6, 3e-6, 7e-6};
  std::vector<double> value;
  for (const double k : key) value.push_back(5 * std::pow(k / 3e-6, -2.5));
  const PowerFit fit = fit_power(key, value);
  EXPECT_NEAR(fit.exponent, -2.5, 1e-12);
  EXPECT_NEAR(fit.value * std::pow(3e-6 / fit.middle, -2.5), 5, 1e-11);
  EXPECT_NEAR(fit.r_squared, 1, 1e-12);
  for (const double local : local_exponents(key, value)) EXPECT_NEAR(local, -2.5, 1e-12);
}

// The tangent of a curved line of logarithms, exact for a parabola inside.
TEST(StudyPower, LocalExponentsFollowACurve) {
  std::vector<double> key, value;
  for (const double x : {0.0, 0.3, 0.4, 0.9}) {
    key.push_back(std::exp(x));
    value.push_back(std::exp(1 + 2 * x - 3 * x * x));
  }
  const std::vector<double> local = local_exponents(key, value);
  EXPECT_NEAR(local[1], 2 - 6 * 0.3, 1e-12);
  EXPECT_NEAR(local[2], 2 - 6 * 0.4, 1e-12);
}

TEST(StudyPower, KeysHaveTheUnitOfTheirDeclaration) {
  EXPECT_EQ(unit_of_key("tip.height"), "m");
  EXPECT_EQ(unit_of_key("material.lever.youngs_modulus"), "Pa");
  EXPECT_EQ(unit_of_key("material[0].poissons_ratio"), "-");
  EXPECT_EQ(unit_of_key("lever.half_angle"), "rad");
  StudyRun run;
  run.varied = {{"tip.height", {std::string("3 um"), {}}, {}},
                {"tip.height", {std::string("4 um"), {}}, {}}};
  EXPECT_NEAR(number_of_key(run, "tip.height").value(), 4e-6, 1e-20);  // the last one wins
  EXPECT_FALSE(number_of_key(run, "tip.offset"));
  run.varied = {{"tip.shape", {std::string("cone"), {}}, {}}};
  EXPECT_FALSE(number_of_key(run, "tip.shape"));
}

}  // namespace
}  // namespace pulvis
