// Variables of a scene: what they stand for, where they are changed, and what is wrong with them.
#include <gmock/gmock.h>

#include <fmt/format.h>

#include <ctime>
#include <fstream>

#include "cli/campaigns/study/analysis/study_power.hpp"
#include "cli/campaigns/study/study_read.hpp"
#include "tests/helpers/program.hpp"
#include "tests/helpers/right_scene.hpp"

namespace pulvis {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string changed(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

const std::string with_variables = [] {
  std::string text = changed(right_scene, "diameter = \"10 mm\"", "diameter = \"D\"");
  text = changed(text, "rows = 2\ncolumns = 2", "rows = \"n\"\ncolumns = \"2*n - 2\"");
  text = changed(text, "point = [\"0 mm\", \"30 mm\"]", "point = [\"0 mm\", \"3*D\"]");
  text = changed(text, "normal = [0, -1]", "normal = [0, \"-n\"]");
  text = changed(text, "coefficient = 0.3", "coefficient = \"mu/2\"");
  text = changed(text, "duration = \"1 ms\"", "duration = \"D/(10 m/s)\"");
  return text + "[let]\nD = \"10 mm\"\nn = 2\nmu = \"0.3*n\"\n";
}();

double diameter_in(const Scene& scene) {
  return std::get<DiscOutline>(scene.particles[0].outline).diameter;
}

std::vector<SceneProblem> problems_with(const std::string& variables) {
  return problems_of(std::string(right_scene) + "[let]\n" + variables);
}

TEST(Let, StandsForNumbersAndQuantities) {
  const Scene scene = load_scene_text(with_variables, "let.toml").scene;
  EXPECT_EQ(diameter_in(scene), 0.01);
  EXPECT_EQ(scene.packings[0].cells[1], 2);
  EXPECT_EQ(scene.packings[0].cells[0], 2);
  EXPECT_EQ(scene.tools[1].point.y(), 3 * 0.01);
  EXPECT_EQ(scene.frictions[0].coefficient, 0.3);
  EXPECT_EQ(scene.stages[0].duration, 0.001);
}

TEST(Let, IsWorkedOutInTheSceneThatIsKept) {
  const LoadedScene loaded = load_scene_text(with_variables, "let.toml");
  EXPECT_THAT(loaded.text, Not(HasSubstr("[let]")));
  EXPECT_THAT(loaded.text, HasSubstr("diameter = \"0.01 m\""));
  EXPECT_THAT(loaded.text, HasSubstr("rows = 2\n"));
  const LoadedScene again = load_scene_text(loaded.text, "let.toml");
  EXPECT_EQ(again.hash, loaded.hash);
  EXPECT_EQ(again.text, loaded.text);
}

TEST(Let, KeepsExactValues) {
  const std::string text = changed(with_variables, "D = \"10 mm\"", "D = \"10.3 mm / 3\"");
  const LoadedScene loaded = load_scene_text(text, "let.toml", {"stage.press.duration=1 ms"});
  const Scene again = load_scene_text(loaded.text, "let.toml").scene;
  EXPECT_EQ(diameter_in(again), 0.0103 / 3);
}

TEST(Let, IsChangedByOverrides) {
  const Scene scene = load_scene_text(with_variables, "let.toml", {"let.D=12 mm"}).scene;
  EXPECT_EQ(diameter_in(scene), 0.012);
  EXPECT_NEAR(scene.tools[1].point.y(), 0.036, 1e-15);
  // An expression may come from the command line, too.
  const std::vector<std::string> overrides{"let.D=2*d", "let.d=6 mm",
                                           "particle.block.width=D + 1 mm"};
  const Scene other = load_scene_text(with_variables, "let.toml", overrides).scene;
  EXPECT_EQ(diameter_in(other), 0.012);
  EXPECT_NEAR(std::get<RectangleOutline>(other.particles[1].outline).width, 0.013, 1e-15);
}

TEST(Let, OfAnOverrideMustBeUsed) {
  const auto problems = problems_of(with_variables, {"let.my=0.5"});
  EXPECT_THAT(problems_of(with_variables, {"let.d=1 mm"})[0].message,
              HasSubstr("did you mean 'D'?"));
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].text(),
            "--set let.my=0.5: let.my: no value uses this variable, did you mean 'mu'?, allowed: "
            "D, n, mu");
}

using LetFiles = ProgramTest;

TEST_F(LetFiles, AreInherited) {
  std::ofstream(place / "base.toml") << with_variables;
  std::ofstream(place / "thin.toml") << "extends = \"base.toml\"\n[let]\nD = \"5 mm*k\"\nk = 2.4\n";
  const Scene scene = load_scene(place / "thin.toml").scene;
  EXPECT_EQ(diameter_in(scene), 0.012);
  EXPECT_EQ(scene.packings[0].cells[1], 2);
}

TEST_F(LetFiles, AreVariedByStudies) {
  std::ofstream(place / "scene.toml") << with_variables;
  std::ofstream(place / "study.toml")
      << "scene = \"scene.toml\"\n[grid]\nlet.D = [\"10 mm\", \"12 mm\"]\n";
  const Study study = load_study(place / "study.toml");
  ASSERT_EQ(study.runs.size(), 2U);
  EXPECT_EQ(diameter_in(study.runs[1].scene), 0.012);
  EXPECT_NE(study.runs[0].hash, study.runs[1].hash);
  EXPECT_EQ(study.variations[1], "D=12mm");
  EXPECT_EQ(number_of_key(study.runs[1], "let.D"), 0.012);
  EXPECT_EQ(unit_of_varied(study.runs, "let.D"), "m");
  EXPECT_EQ(unit_of_varied(study.runs, "tip.height"), "m");
}

// Each is defined by its neighbour, forwards or backwards: neither time nor stack grows with more than their number.
TEST(Let, ChainsMayBeLong) {
  constexpr int number = 8'000;
  std::string forwards = "v0 = \"1 mm\"\n", backwards, circle;
  for (int i = 1; i < number; ++i) {
    forwards += fmt::format("v{} = \"v{} + 1 mm\"\n", i, i - 1);
    backwards += fmt::format("w{} = \"w{} + 1 mm\"\n", i - 1, i);
    circle += fmt::format("c{} = \"c{}\"\n", i, i % (number - 1) + 1);
  }
  const std::clock_t start = std::clock();  // of the processor: other tests run, too
  const std::string text = changed(right_scene, "diameter = \"10 mm\"", "diameter = \"D\"") +
                           fmt::format("[let]\nD = \"(v{} + w0)/{}\"\nw{} = \"0 mm\"\n", number - 1,
                                       (2 * number - 1) / 10.0, number - 1) +
                           forwards + backwards;
  EXPECT_NEAR(diameter_in(load_scene_text(text, "let.toml").scene), 0.01, 1e-9);
  const auto problems = problems_with(circle);
  EXPECT_EQ(problems.size(), 1U);
  EXPECT_LT(problems.at(0).message.size(), 300U);
  EXPECT_LT(std::clock() - start, 10 * CLOCKS_PER_SEC);
}

TEST(Let, MayBeWithoutVariables) {
  const std::string text = changed(right_scene, "diameter = \"10 mm\"", "diameter = \"2 * 5 mm\"");
  EXPECT_EQ(diameter_in(load_scene_text(text, "let.toml").scene), 0.01);
}

struct WrongLet {
  const char* name;
  const char* variables;
  const char* key;
  std::vector<const char*> says;
};

void PrintTo(const WrongLet& wrong, std::ostream* stream) { *stream << wrong.name; }

class WrongLets : public testing::TestWithParam<WrongLet> {};

TEST_P(WrongLets, AreRefusedAtTheirPlace) {
  const auto problems = problems_with(GetParam().variables);
  ASSERT_FALSE(problems.empty());
  EXPECT_EQ(problems[0].key, GetParam().key);
  EXPECT_GT(problems[0].line, 60);
  for (const char* part : GetParam().says) EXPECT_THAT(problems[0].message, HasSubstr(part));
}

INSTANTIATE_TEST_SUITE_P(
    All, WrongLets,
    testing::Values(
        WrongLet{"Circle",
                 "a = \"2*b\"\nb = \"c + 1\"\nc = \"a\"\n",
                 "let.c",
                 {"is defined in terms of itself: a -> b -> c -> a"}},
        WrongLet{"Itself", "a = \"a + 1\"\n", "let.a", {"itself: a -> a"}},
        WrongLet{"Unknown",
                 "gap = \"D/2\"\nd = \"1 mm\"\n",
                 "let.gap",
                 {"\"D/2\": no variable is called 'D', did you mean 'd'?, allowed: gap, d"}},
        WrongLet{"Near", "gap = \"Dia/2\"\ndia = \"1 mm\"\n", "let.gap", {"did you mean 'dia'?"}},
        WrongLet{"Dimension", "a = \"1 mm + 2 N\"\n", "let.a", {"the dimensions differ"}},
        WrongLet{
            "Function", "sin = 3\n", "let.sin", {"is not a valid variable name", "none of pi"}},
        WrongLet{"Hyphen", "a-b = 3\n", "let.a-b", {"is not a valid variable name"}},
        WrongLet{"Flag", "a = true\n", "let.a", {"a boolean is given", "allowed: a number"}},
        WrongLet{"Table", "a = {b = 3}\n", "let.a", {"a table is given"}},
        WrongLet{"Infinite", "a = inf\n", "let.a", {"not finite"}}),
    [](const auto& tested) { return std::string(tested.param.name); });

TEST(WrongLets, AreToldOnce) {
  EXPECT_EQ(problems_with("a = \"x\"\nb = \"2*a\"\nc = \"b + a\"\n").size(), 1U);
  EXPECT_EQ(problems_with("a = \"x\"\nb = \"y\"\nc = \"b + a\"\n").size(), 2U);
}

TEST(WrongLets, AreNoTable) {
  const auto problems = problems_of("let = 3\n" + std::string(right_scene));
  EXPECT_EQ(problems[0].key, "let");
  EXPECT_THAT(problems[0].message, HasSubstr("allowed: one table, [let]"));
}

std::string problem_with(const std::string& from, const std::string& to) {
  const auto problems = problems_of(changed(with_variables, from, to));
  return problems.empty() ? "" : problems[0].key + ": " + problems[0].message;
}

TEST(WrongUses, NameTheKeyAndTheExpression) {
  EXPECT_EQ(
      problem_with("\"3*D\"", "\"3*mue\""),
      "tool[1].point: \"3*mue\": no variable is called 'mue', did you mean 'mu'?, allowed: D, "
      "n, mu");
  EXPECT_THAT(problem_with("\"3*D\"", "\"3*n\""),
              HasSubstr("tool[1].point: \"3*n\": is 6, a plain number, allowed: two quantities"));
  EXPECT_THAT(problem_with("\"mu/2\"", "\"D/2\""), HasSubstr("is 0.005 m, allowed: a number"));
  EXPECT_THAT(
      problem_with("\"n\"", "\"n/3\""),
      HasSubstr("packing[0].rows: \"n/3\": is 0.6666666666666666, allowed: a whole number"));
  EXPECT_THAT(problem_with("\"n\"", "\"-n\""), HasSubstr("packing[0].rows: -2 is out of range"));
  EXPECT_THAT(problem_with("\"3*D\"", "\"3 D\""), HasSubstr("write \"3*D\""));
}

// Names and words are not looked at.
TEST(Let, LeavesTextsAlone) {
  const std::string text = changed(changed(with_variables, "title = \"right\"", "title = \"n*D\""),
                                   "D = \"10 mm\"", "D = \"10 mm\"\ndisc = 3\ngrain = 4\n");
  const Scene scene = load_scene_text(text, "let.toml").scene;
  EXPECT_EQ(scene.title, "n*D");
  EXPECT_EQ(scene.particles[0].name, "grain");
}

}  // namespace
}  // namespace pulvis
