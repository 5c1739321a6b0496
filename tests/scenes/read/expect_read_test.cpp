// [[expect]] as it is read: what it may say, and how contradictions are refused.
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "tests/helpers/right_scene.hpp"

namespace pulvis {
namespace {

using testing::HasSubstr;
using When = ExpectSpec::When;

std::string with(const std::string& expect) {
  return std::string(right_scene) + "\n[[expect]]\n" + expect;
}

ExpectSpec read(const std::string& expect) {
  return load_scene_text(with(expect), "e.toml").scene.expects.at(0);
}

TEST(ExpectRead, ASceneWithoutHasNone) {
  EXPECT_TRUE(load_scene_text(right_scene, "e.toml").scene.expects.empty());
}

TEST(ExpectRead, BoundsAreNumbersInSiOrQuantities) {
  const ExpectSpec e = read("series = \"tool/top/force_y\"\nabove = 5\nbelow = \"2 kN\"");
  EXPECT_EQ(e.series, "tool/top/force_y");
  EXPECT_FALSE(e.when.has_value());
  EXPECT_EQ(e.above->number, 5);
  EXPECT_EQ(e.below->number, 2000);
  EXPECT_FALSE(e.equals.has_value());
}

TEST(ExpectRead, AValueAShareOfTheRunAndAWord) {
  const ExpectSpec e = read(
      "series = \"energy/kinetic\"\nwhen = \"range\"\nequals = \"3 mJ\"\nwithin = 0.1\n"
      "from = 0.25\nuntil = 0.5");
  EXPECT_EQ(e.when, When::range);
  EXPECT_DOUBLE_EQ(e.equals->number, 3e-3);
  EXPECT_EQ(e.within, 0.1);
  EXPECT_EQ(e.from, 0.25);
  EXPECT_EQ(e.until, 0.5);
}

TEST(ExpectRead, AnOutcome) {
  const ExpectSpec e = read("outcome = \"stops\"\nmessage = \"particle [0-9]+\"");
  EXPECT_TRUE(e.stops);
  EXPECT_EQ(e.message, "particle [0-9]+");
}

TEST(ExpectRead, AnOverrideReachesABound) {
  const std::string text = with("series = \"penetration\"\nbelow = 0.1");
  const Scene scene = load_scene_text(text, "e.toml", {"expect[0].below=0.2"}).scene;
  EXPECT_EQ(scene.expects.at(0).below->number, 0.2);
}

struct WrongExpect {
  const char* name;
  const char* text;
  const char* key;  // after "expect[0]"
  const char* says;
};
void PrintTo(const WrongExpect& wrong, std::ostream* stream) { *stream << wrong.name; }

class WrongExpectation : public testing::TestWithParam<WrongExpect> {};

TEST_P(WrongExpectation, IsRefused) {
  const auto problems = problems_of(with(GetParam().text));
  ASSERT_FALSE(problems.empty());
  EXPECT_EQ(problems.front().key, std::string("expect[0]") + GetParam().key);
  EXPECT_THAT(problems.front().message, HasSubstr(GetParam().says));
  const auto lines = std::ranges::count(std::string(right_scene), '\n');
  EXPECT_GE(problems.front().line, lines + 2);  // in the table, not somewhere in the scene
}

const WrongExpect wrongs[] = {
    {"Nothing", "", "", "neither or both of `series` and `outcome`"},
    {"Both", "series = \"dt\"\nbelow = 1\noutcome = \"stops\"\nmessage = \"a\"", "",
     "neither or both of `series` and `outcome`"},
    {"UnknownSeries", "series = \"tool/top/forcey\"\nbelow = 1", ".series",
     "did you mean 'tool/top/force_y'?"},
    {"SeriesOfADieWithoutADie", "series = \"relative_density\"\nbelow = 1", ".series",
     "no such series"},
    {"NoBound", "series = \"dt\"", ".series", "none of bounds"},
    {"BoundsAndAValue", "series = \"dt\"\nbelow = 1\nequals = 1\nwithin = 0.1", ".series",
     "more than one"},
    {"EmptyRange", "series = \"dt\"\nabove = 2\nbelow = 1", ".above", "above <= below"},
    {"ValueWithoutNearness", "series = \"dt\"\nequals = 1", ".within", "required key"},
    {"BoundWithNearness", "series = \"dt\"\nbelow = 1\nwithin = 0.1", ".within", "no effect"},
    {"WrongUnit", "series = \"dt\"\nbelow = \"1 N\"", ".below", "a quantity of that dimension"},
    {"UnitWhereNoneIs", "series = \"penetration\"\nbelow = \"1 m\"", ".below", "dimensionless"},
    {"ShareOfTheEnd", "series = \"dt\"\nbelow = 1\nfrom = 0.5", ".from", "another `when`"},
    {"EmptyShare", "series = \"dt\"\nwhen = \"max\"\nbelow = 1\nfrom = 0.5\nuntil = 0.5", ".from",
     "from < until"},
    {"FigureNotAtTheEnd", "series = \"kinetic_ratio\"\nwhen = \"max\"\nbelow = 1", ".when",
     "one value"},
    {"UnknownWhen", "series = \"dt\"\nwhen = \"alwais\"\nbelow = 1", ".when",
     "did you mean 'always'?"},
    {"NoMessage", "outcome = \"stops\"", ".message", "required key"},
    {"NoRegularExpression", "outcome = \"stops\"\nmessage = \"(\"", ".message",
     "not a regular expression"},
    {"MessageWithoutOutcome", "series = \"dt\"\nbelow = 1\nmessage = \"a\"", ".message",
     "only together with outcome"},
    {"ScaleWithoutScene", "series = \"dt\"\nbelow = 1\nscale = 2", ".scale",
     "only together with like"},
    {"NoSuchScene", "series = \"dt\"\nlike = \"nowhere.toml\"\nwithin = 0.1", ".like",
     "there is no such file"},
    {"ComparedByTheMean", "series = \"dt\"\nwhen = \"mean\"\nlike = \"nowhere.toml\"\nwithin = 0.1",
     ".when", "sample by sample"},
};
INSTANTIATE_TEST_SUITE_P(Cases, WrongExpectation, testing::ValuesIn(wrongs),
                         [](const auto& wrong) { return std::string(wrong.param.name); });

TEST(ExpectRead, TwoOutcomesAreOneTooMany) {
  const std::string once = "outcome = \"stops\"\nmessage = \"a\"\n";
  const auto problems = problems_of(with(once + "[[expect]]\n" + once));
  EXPECT_EQ(problems.front().key, "expect[1].outcome");
}

// Two scenes that name each other are not followed for ever.
TEST(ExpectRead, ScenesMayNameEachOther) {
  const auto folder =
      std::filesystem::temp_directory_path() / ("pulvis-expect-read-" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  for (const auto& [own, other] : {std::pair{"a.toml", "b.toml"}, {"b.toml", "a.toml"}})
    std::ofstream(folder / own) << with("series = \"dt\"\nwithin = 0.1\nlike = \"" +
                                        std::string(other) + "\"");
  EXPECT_EQ(read_scene(folder / "a.toml").expects.at(0).like, "b.toml");
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace pulvis
