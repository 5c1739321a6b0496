// Figures that a study takes of curves, and the verdicts on them.
#include "cli/campaigns/study/analysis/study_trends.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "cli/campaigns/study/analysis/study_series.hpp"
#include "scenes/read.hpp"
#include "tests/helpers/paths.hpp"

namespace pulvis {
namespace {

using ::testing::HasSubstr;
using Values = std::vector<double>;
using When = StudyExpect::When;

StudyExpect at(double place) {
  StudyExpect expect;
  expect.at = StudyExpect::Bound{place, ""};
  return expect;
}

TEST(StudyFigure, ValueAtAPlaceIsInterpolatedWhereItIsFirstPassed) {
  const Values x{0, 1, 2, 1, 0}, y{0, 10, 20, 50, 60};
  EXPECT_DOUBLE_EQ(figure_of(at(0.5), x, y), 5);
  EXPECT_DOUBLE_EQ(figure_of(at(2), x, y), 20);
  EXPECT_DOUBLE_EQ(figure_of(at(1), x, y), 10);
  EXPECT_TRUE(std::isnan(figure_of(at(2.1), x, y)));
  EXPECT_TRUE(std::isnan(figure_of(at(1), {}, {})));
}

TEST(StudyFigure, WindowEndsWhereItIsFirstPassed) {
  const Values x{0, 1, 2, 3, 2, 1}, y{1, 2, 3, 4, 100, -100};
  StudyExpect expect;
  expect.from = StudyExpect::Bound{1, ""};
  expect.until = StudyExpect::Bound{2, ""};
  expect.when = When::mean;
  EXPECT_DOUBLE_EQ(figure_of(expect, x, y), 2.5);
  expect.when = When::max;
  EXPECT_DOUBLE_EQ(figure_of(expect, x, y), 3);
  expect.until.reset();
  EXPECT_DOUBLE_EQ(figure_of(expect, x, y), 100);
  expect.when = When::min;
  EXPECT_DOUBLE_EQ(figure_of(expect, x, y), -100);
}

// Straight lines are smooth whatever their slope; a fast wave is as rough as its own rms over its range.
TEST(StudyFigure, RoughnessIsThatOfTheWaveOnTheCurve) {
  Values line, wave;
  for (int i = 0; i < 2000; ++i) {
    line.push_back(3 - 0.7 * i);
    wave.push_back(0.5 * std::sin(2 * std::numbers::pi * i / 10.0));  // ten samples a period
  }
  EXPECT_LT(roughness(line), 1e-12);
  EXPECT_NEAR(roughness(wave), 0.5 / std::sqrt(2.0) / (2 * 0.5 * std::sin(0.4 * std::numbers::pi)),
              0.01);
  EXPECT_EQ(roughness(Values(100, 4.0)), 0);
  EXPECT_TRUE(std::isnan(roughness(Values{1, 2})));
}

// Slow curvature counts little: a parabola over the whole range is 1/20^2 of it off its chord at most.
TEST(StudyFigure, RoughnessOfASmoothCurveIsNextToNothing) {
  Values parabola;
  for (int i = 0; i < 1000; ++i) parabola.push_back(i * 1e-3 * i * 1e-3);
  EXPECT_LT(roughness(parabola), 1e-3);
}

// Runs a, b, c whose series are constants, and the verdicts of one expectation on them.
class StudyVerdict : public ::testing::Test {
 protected:
  StudyVerdict() {
    const Scene scene = read_scene(paths::source_dir() + "/scenes/compaction/regular-25.toml");
    for (const char* name : {"a", "b", "b2", "c"}) {
      StudyRun run;
      run.name = name;
      run.variation = std::string(name).substr(0, 1);
      run.scene = scene;
      study.runs.push_back(run);
    }
    study.variations = {"a", "b", "c"};
  }

  Verdict verdict(const StudyExpect& expect, const std::string& broken = "") {
    study.spec.expects = {expect};
    return judge_study(
               study,
               [&](const StudyRun& run, const std::string& series) {
                 return series == "time" ? Values{0, 1} : Values{0, value.at(run.name)};
               },
               [&](const StudyRun& run) { return run.name == broken ? "crashed" : ""; })
        .front();
  }

  static StudyExpect force() {
    StudyExpect expect;
    expect.series = "tool/top/force_y";
    expect.against = "time";
    return expect;
  }

  Study study;
  std::map<std::string, double> value{{"a", 1}, {"b", 1.9}, {"b2", 2.1}, {"c", 4}};
};

TEST_F(StudyVerdict, OrderIsOfTheMeansOverSeeds) {
  StudyExpect expect = force();
  expect.order = {"a", "b", "c"};
  expect.trend = StudyExpect::Trend::increasing;
  EXPECT_TRUE(verdict(expect).met);
  EXPECT_THAT(verdict(expect).measured, HasSubstr("1, 2, 4 N"));
  expect.by = 0.5;  // 2 is just 50% of 4
  EXPECT_TRUE(verdict(expect).met);
  expect.by = 0.51;
  EXPECT_FALSE(verdict(expect).met);
  expect.by = 0;
  expect.trend = StudyExpect::Trend::decreasing;
  EXPECT_FALSE(verdict(expect).met);
  expect.order = {"c", "b", "a"};
  EXPECT_TRUE(verdict(expect).met);
  value["a"] = 2;  // equal values have no order
  EXPECT_FALSE(verdict(expect).met);
}

TEST_F(StudyVerdict, RatioEffectAndValueKeepTheirBounds) {
  StudyExpect ratio = force();
  ratio.ratio = {"c", "b"};
  ratio.equals = StudyExpect::Bound{2, ""};
  ratio.within = 1e-9;
  EXPECT_TRUE(verdict(ratio).met);
  EXPECT_DOUBLE_EQ(*verdict(ratio).value, 2);
  ratio.equals->number = 2.1;
  EXPECT_FALSE(verdict(ratio).met);

  StudyExpect effect = force();
  effect.effect = {"c", "b"};
  effect.exceeds = {"b", "a"};
  EXPECT_TRUE(verdict(effect).met);  // 2 against 1, whichever way each goes
  effect.factor = 2.01;
  EXPECT_FALSE(verdict(effect).met);

  StudyExpect one = force();
  one.of = "c";
  one.above = StudyExpect::Bound{4, ""};
  EXPECT_TRUE(verdict(one).met);
  one.above.reset();
  one.below = StudyExpect::Bound{3.9, ""};
  EXPECT_FALSE(verdict(one).met);
}

TEST_F(StudyVerdict, ARunThatFailedMeetsNothing) {
  StudyExpect expect = force();
  expect.of = "b";
  expect.above = StudyExpect::Bound{0, ""};
  EXPECT_TRUE(verdict(expect).met);
  const Verdict broken = verdict(expect, "b2");
  EXPECT_FALSE(broken.met);
  EXPECT_EQ(broken.measured, "no result of b2: crashed");
  expect.at = StudyExpect::Bound{7, ""};
  EXPECT_THAT(verdict(expect).measured, HasSubstr("does not reach it"));
}

TEST(StudySeries, TravelInSpaceIsAlongAllThreeAxes) {
  const Scene scene = read_scene(paths::source_dir() + "/scenes/compaction-3d/one-sphere.toml");
  const History history = [](const std::string& name) -> Values {
    if (name == "tool/top/position_x") return {1, 1, 4};
    if (name == "tool/top/position_z") return {7, 5, 3};
    return {0, 0, 0};
  };
  EXPECT_EQ(study_values(scene, "travel/top", history), (Values{0, 2, 5}));
  const auto is_travel = [](const SeriesInfo& series) { return series.name == "travel/top"; };
  EXPECT_TRUE(std::ranges::any_of(study_series(scene), is_travel));
}

// Derived series, from a history that was made up.
TEST(StudySeries, AreMadeOfTheHistory) {
  const Scene scene = read_scene(paths::source_dir() + "/scenes/compaction/regular-25.toml");
  const History history = [](const std::string& name) -> Values {
    if (name == "tool/top/position_y") return {0.050, 0.047, 0.046};
    if (name == "tool/right/position_x") return {0.050, 0.050, 0.050};
    if (name == "tool/top/force_y") return {0, 100, 1000};
    if (name == "tool/bottom/force_y") return {0, -90, -800};
    return {0, 0, 0};
  };
  const auto of = [&](const char* name) { return study_values(scene, name, history); };
  EXPECT_NEAR(of("travel/top")[1], 0.003, 1e-15);
  EXPECT_NEAR(of("pressure/top")[2], 1000 / (0.05 * 1e-3), 1e-6);
  EXPECT_NEAR(of("pressure/bottom")[2], 800 / (0.05 * 1e-3), 1e-6);
  EXPECT_TRUE(std::isnan(of("transmission")[0]));
  EXPECT_NEAR(of("transmission")[1], 0.9, 1e-15);
  EXPECT_EQ(of("tool/top/force_y")[2], 1000);
}

}  // namespace
}  // namespace pulvis
