// Effects of conditions: known ones are found again within their intervals, interactions are told, and what cannot be told
// apart is refused.
#include "cli/laboratory/lab_matrix.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/helpers/paths.hpp"
#include "tests/helpers/program.hpp"
#include "tests/helpers/wrong.hpp"

namespace pulvis::lab {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class LabMatrix : public ProgramTest {};

double probability_of(const nlohmann::json& effects, const std::string& factor) {
  for (const auto& test : effects["tests"])
    if (test["factor"] == factor) return test["probability"];
  ADD_FAILURE() << factor;
  return -1;
}

TEST_F(LabMatrix, TheShippedRecordsGiveTheirEffectsBack) {
  const fs::path folder = fs::path(paths::source_dir()) / "scenes/lab";
  const Outcome outcome = pulvis({"reduce", (folder / "matrix.toml").string(), "-o", "done"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto truth = nlohmann::json::parse(text_of(folder / "matrix-truth.json"));
  const auto summary = nlohmann::json::parse(text_of(place / "done/summary.json"));
  EXPECT_EQ(summary["conditions"].size(), 16u);
  const auto& dynamic = summary["effects"]["dynamic"];
  const std::map<std::string, std::string> levels{{"500 N", "500 N"}, {"1000 N", "1 kN"}};
  int within = 0;
  for (const auto& effect : dynamic["effects"]) {
    const std::string level = effect["level"];
    const auto named = levels.find(level);
    const double made = truth["effects"][effect["factor"].get<std::string>()]
                             [named == levels.end() ? level : named->second];
    within += std::abs(effect["effect"].get<double>() - made) <= effect["half_width"].get<double>();
    EXPECT_NEAR(effect["effect"], made, 0.0008) << level;  // of a scatter of 0.002 over 32 runs
  }
  EXPECT_GE(within, 8);  // of 10, in pairs
  EXPECT_NEAR(dynamic["mean"], truth["mean"], 0.001);
  EXPECT_NEAR(dynamic["deviation_of_a_run"], truth["scatter"], 0.0008);
  EXPECT_LT(probability_of(dynamic, "roughness"), 1e-6);
  EXPECT_GT(probability_of(dynamic, "speed"), 0.05);
  EXPECT_GT(probability_of(dynamic, "interactions"), 0.05);
  EXPECT_THAT(text_of(place / "done/conditions.csv"),
              HasSubstr("load,roughness,direction,speed,powder,runs [-],static [-]"));
}

Factor factor(const char* name, std::vector<std::size_t> of_run) {
  std::size_t levels = 0;
  for (const std::size_t level : of_run) levels = std::max(levels, level + 1);
  Factor made{name, {}, std::move(of_run)};
  for (std::size_t i = 0; i < levels; ++i) made.levels.push_back(std::string(1, char('a' + i)));
  return made;
}

// Worked by hand: means 1, 2, 3, 6 of two runs each, +-0.1 about them. Effects -+0.5(2.5 - ...) of a balanced table;
// interaction (6 - 3 - 2 + 1)/4 = 0.5, its sum of squares 8 x 0.25 = 2, pure error 8 x 0.01/4 = 0.02: F = 100.
TEST_F(LabMatrix, ABalancedTableIsThatOfTheBooks) {
  const std::vector<Factor> factors{factor("row", {0, 0, 0, 0, 1, 1, 1, 1}),
                                    factor("column", {0, 0, 1, 1, 0, 0, 1, 1})};
  const std::vector<double> values{0.9, 1.1, 1.9, 2.1, 2.9, 3.1, 5.9, 6.1};
  const Effects found = effects_of(factors, conditions_of(factors), values, 0.95);
  ASSERT_EQ(found.not_found, "");
  EXPECT_NEAR(found.mean, 3, 1e-12);
  EXPECT_NEAR(found.effects[0].value, -1.5, 1e-12);
  EXPECT_NEAR(found.effects[2].value, -1, 1e-12);
  EXPECT_EQ(found.freedom, 4);
  EXPECT_NEAR(found.deviation, std::sqrt(0.02), 1e-12);
  EXPECT_NEAR(*found.effects[0].half_width, 2.776445 * std::sqrt(0.02 / 8), 1e-6);
  ASSERT_EQ(found.tests.size(), 3u);
  EXPECT_NEAR(found.tests[0].f, 8 * 2.25 / 0.02, 1e-9);
  EXPECT_EQ(found.tests[2].factor, "interactions");
  EXPECT_NEAR(found.tests[2].f, 100, 1e-9);
  // F with 1 and 4 degrees is the square of Student's t with 4: t = 10.
  EXPECT_NEAR(found.tests[2].probability, 1 - student_probability(10, 4), 1e-12);
}

TEST_F(LabMatrix, WithoutRepeatedRunsTheResidualsAreTheScatter) {
  const std::vector<Factor> factors{factor("row", {0, 0, 1, 1}), factor("column", {0, 1, 0, 1})};
  const Effects found = effects_of(factors, conditions_of(factors), {1, 2, 3, 6}, 0.95);
  EXPECT_FALSE(found.is_pure_error);
  EXPECT_EQ(found.freedom, 1);
  EXPECT_NEAR(found.deviation, 1, 1e-12);  // residuals +-0.5
}

TEST_F(LabMatrix, RefusesWhatCannotBeToldApart) {
  const std::vector<Factor> same{factor("row", {0, 0, 1, 1}), factor("column", {0, 0, 1, 1})};
  EXPECT_THAT(effects_of(same, conditions_of(same), {1, 2, 3, 4}, 0.95).not_found,
              HasSubstr("always change together"));
  const std::vector<Factor> one{factor("row", {0, 0})};
  EXPECT_THAT(effects_of(one, conditions_of(one), {1, 2}, 0.95).not_found,
              HasSubstr("all runs have the same condition"));
  const std::string run = "[[run]]\npress = \"p.csv\"\nlogger = \"l.csv\"\nlength = \"1 cm\"\n";
  EXPECT_THAT(message_of([&] {
                load_settings_text(run + "powder = \"316L\"\n" + run + "speed = \"1 mm/s\"\n" +
                                       "powder = \"316L\"\n",
                                   "reduce.toml", {});
              }),
              HasSubstr("run[1]: states speed, powder as its condition, the first run powder"));
}

}  // namespace
}  // namespace pulvis::lab
