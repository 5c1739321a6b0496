// Expectations held against runs: each `when` against the samples themselves, other scenes, outcomes,
// and what the program tells the shell.
#include "scenes/expectations.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "scenes/read.hpp"
#include "scenes/simulation.hpp"
#include "tests/helpers/paths.hpp"

namespace pulvis {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

// A coarse disc pressed by platens and let go: the force rises, falls, and is 0 at the end.
constexpr const char* pressed = R"(family = "compaction"
material = [{name = "m", density = "7990 kg/m^3", youngs_modulus = "200 GPa", poissons_ratio = 0.3}]
particle = [{name = "disc", material = "m", outline = "disc", diameter = "10 mm", mesh = {boundary_edges = 8}}]
body = [{particle = "disc", position = ["0 mm", "5 mm"]}]
tool = [{name = "bottom", shape = "plane", point = ["0 mm", "0 mm"], normal = [0, 1]},
        {name = "top", shape = "plane", point = ["0 mm", "10 mm"], normal = [0, -1]}]
stage = [{name = "press", kind = "compact", duration = "50 us", move = [{tool = "top", displacement = ["0 mm", "-0.05 mm"]}]},
         {name = "leave", kind = "unload", duration = "50 us", move = [{tool = "top", displacement = ["0 mm", "0.1 mm"]}]}]
output = {frames = 1, samples = 40}
)";

std::string expect(const std::string& text) { return "[[expect]]\n" + text + "\n"; }

// Runs `text` with 41 samples; keeps the punch force next to the verdicts.
struct Judged {
  std::vector<double> time, force;
  double end = 0;
  std::vector<Verdict> verdicts;

  explicit Judged(const std::string& text) {
    const Scene scene = load_scene_text(text, "j.toml").scene;
    Simulation simulation(scene);
    Results results(scene, simulation.world());
    Expectations expectations(scene);
    end = simulation.clock().end;
    for (int i = 0; i <= 40; ++i) {
      simulation.run_until(i < 40 ? end * i / 40 : end);
      simulation.observe();
      results.sample();
      time.push_back(simulation.clock().time);
      force.push_back(results.value("tool/top/force_y"));
      expectations.sample(time.back(), results);
      if (i < 40) simulation.move();
    }
    verdicts = expectations.judge(results, {}, 1);
  }
};

TEST(Expectations, EachWhenMeansWhatItSays) {
  std::string text = pressed;
  for (const char* when : {"end", "max", "min", "mean", "range"})
    text +=
        expect("series = \"tool/top/force_y\"\nbelow = 1e9\nwhen = \"" + std::string(when) + '"');
  const Judged run(text);
  ASSERT_EQ(run.verdicts.size(), 6U);  // the outcome first
  double sum = 0;
  for (const double force : run.force) sum += force;
  const double largest = std::ranges::max(run.force), smallest = std::ranges::min(run.force);
  EXPECT_GT(largest, 100);
  EXPECT_EQ(run.verdicts[1].value, run.force.back());
  EXPECT_EQ(run.verdicts[2].value, largest);
  EXPECT_EQ(run.verdicts[3].value, smallest);
  EXPECT_DOUBLE_EQ(*run.verdicts[4].value, sum / 41);
  EXPECT_EQ(run.verdicts[5].value, largest - smallest);
  EXPECT_TRUE(all_met(run.verdicts));
}

TEST(Expectations, AlwaysIsNotMetByOneSampleOutside) {
  const Judged inside(pressed + expect("series = \"tool/top/force_y\"\nwhen = \"always\"\n"
                                       "above = 0"));
  EXPECT_TRUE(all_met(inside.verdicts));
  const double largest = std::ranges::max(inside.force);
  const auto below = [&](double bound) {
    return Judged(pressed + expect("series = \"tool/top/force_y\"\nwhen = \"always\"\nbelow = " +
                                   std::to_string(bound)));
  };
  EXPECT_TRUE(all_met(below(largest * 1.001).verdicts));
  const Judged outside = below(largest * 0.999);
  EXPECT_FALSE(all_met(outside.verdicts));
  EXPECT_EQ(outside.verdicts[1].value, largest);  // the sample that is furthest out
}

TEST(Expectations, OnlySamplesOfTheShareCount) {
  const Judged run(pressed + expect("series = \"tool/top/force_y\"\nwhen = \"max\"\nuntil = 0.2\n"
                                    "below = 1e9"));
  double largest = 0;
  for (std::size_t i = 0; i < run.time.size(); ++i)
    if (run.time[i] <= 0.2 * run.end) largest = std::max(largest, run.force[i]);
  EXPECT_EQ(run.verdicts[1].value, largest);
  EXPECT_LT(largest, std::ranges::max(run.force));
}

TEST(Expectations, EqualsIsRelativeOrToZeroAbsolute) {
  const Judged plain(pressed +
                     expect("series = \"tool/top/force_y\"\nwhen = \"max\"\nbelow = 1e9"));
  const double largest = std::ranges::max(plain.force);
  const auto met = [&](double equals, double within) {
    return all_met(
        Judged(pressed + expect("series = \"tool/top/force_y\"\nwhen = \"max\"\nequals = " +
                                std::to_string(equals) + "\nwithin = " + std::to_string(within)))
            .verdicts);
  };
  EXPECT_TRUE(met(largest / 1.01, 0.011));
  EXPECT_FALSE(met(largest / 1.01, 0.009));
  EXPECT_TRUE(met(0, largest * 1.001));
  EXPECT_FALSE(met(0, largest * 0.999));
}

class Program : public testing::Test {
 protected:
  void SetUp() override {
    place = fs::temp_directory_path() / ("pulvis-expectations-" + std::to_string(getpid()));
    fs::create_directories(place);
  }
  void TearDown() override { fs::remove_all(place); }

  // Exit code of a run of `text`; what it printed is in `out`.
  int run(const std::string& text, const std::string& more = "") {
    std::ofstream(place / "scene.toml") << text;
    const std::string at = place.string();
    const int status = std::system((std::string("'") + paths::program() + "' run '" + at +
                                    "/scene.toml' -o '" + at + "/run' --overwrite --threads 1 " +
                                    more + " > '" + at + "/out' 2> '" + at + "/err'")
                                       .c_str());
    std::ostringstream printed;
    printed << std::ifstream(place / "out").rdbuf();
    out = printed.str();
    return WEXITSTATUS(status);
  }
  nlohmann::json summary() const {
    return nlohmann::json::parse(std::ifstream(place / "run/summary.json"));
  }

  fs::path place;
  std::string out;
};

TEST_F(Program, WithoutExpectationsSaysNothingOfThem) {
  EXPECT_EQ(run(pressed), 0);
  EXPECT_THAT(out, testing::Not(HasSubstr("\nexpectations\n")));
  EXPECT_FALSE(summary().contains("expectations"));
  EXPECT_GT(summary()["min_jacobian"], 0.9);
  EXPECT_LT(summary()["min_jacobian"], 1);
}

TEST_F(Program, MetAndNotMet) {
  const std::string right =
      expect("series = \"tool/top/force_y\"\nwhen = \"min\"\nabove = \"0 N\"");
  EXPECT_EQ(run(pressed + right), 0);
  EXPECT_THAT(out, HasSubstr("  met      tool/top/force_y, smallest: 0 N; expected: at least 0 N"));
  EXPECT_EQ(run(pressed + right + expect("series = \"energy_balance_error\"\nbelow = 1e-30")), 3);
  EXPECT_THAT(out, HasSubstr("  NOT met  energy_balance_error: "));
  EXPECT_EQ(summary()["outcome"], "done");
  EXPECT_EQ(summary()["expectations"].size(), 3U);
  EXPECT_EQ(summary()["expectations"][1]["met"], true);
  EXPECT_EQ(summary()["expectations"][2]["met"], false);
  EXPECT_EQ(summary()["expectations"][2]["value"], summary()["energy_balance_error"]);
}

// Twice the thickness, twice the force: the same bits, since the stresses are the same.
TEST_F(Program, AnotherSceneTimesAScale) {
  std::ofstream(place / "other.toml") << pressed;
  const std::string thick = "thickness = \"2 mm\"\n" + std::string(pressed);
  const std::string like = "series = \"tool/top/force_y\"\nlike = \"other.toml\"\nwithin = 1e-12\n";
  EXPECT_EQ(run(thick + expect(like + "scale = 2.0")), 0) << out;
  EXPECT_EQ(run(thick + expect(like)), 3);
  EXPECT_THAT(out, HasSubstr(": off by 1; expected: within 1e-12 of the value of other.toml\n"));
  EXPECT_EQ(run(thick + expect(like + "scale = 2.0"), "--set 'body[0].angle=10 deg'"), 3);
}

TEST_F(Program, TwoExpectationsOfOneSeriesAndScene) {
  std::ofstream(place / "other.toml") << pressed;
  const std::string like = "series = \"tool/top/force_y\"\nlike = \"other.toml\"\nwithin = 1e-12\n";
  EXPECT_EQ(run(pressed + expect(like) + expect(like + "when = \"end\"")), 0) << out;
}

// A value that one run does not have is not like one that the other has, wherever it is.
TEST_F(Program, ASampleWithoutAValueIsLikeNoOther) {
  const fs::path other = place / "other.toml", own = place / "scene.toml";
  std::ofstream(other) << pressed;
  std::ofstream(own) << pressed
                     << expect(
                            "series = \"tool/top/force_y\"\nlike = \"other.toml\"\n"
                            "within = 1e9");
  const Scene scene = load_scene(own, {}).scene;
  const Judged run(pressed);
  for (const std::size_t without : {0U, 20U, 40U}) {
    Expectations expectations(scene);
    for (std::size_t i = 0; i < run.time.size(); ++i)
      expectations.sample(run.time[i], [&](const std::string&) {
        return i == without ? std::nan("") : run.force[i] + 1;
      });
    const auto verdicts =
        expectations.judge([](const std::string&) { return 0.0; }, run.end, {}, 1);
    EXPECT_FALSE(verdicts[1].met) << without;
    EXPECT_EQ(verdicts[1].measured, "some samples have a value in one run only");
  }
}

TEST_F(Program, AStopThatIsExpected) {
  const std::string limit = "[limits]\npenetration = 1e-5\n";
  EXPECT_EQ(run(pressed + limit), 3);
  EXPECT_EQ(run(pressed + limit + expect("series = \"dt\"\nabove = 0")), 3);
  EXPECT_THAT(out, HasSubstr("NOT met  outcome: stopped: tool_contact: particle 0"));
  const std::string stops =
      expect("outcome = \"stops\"\nmessage = 'against tool .top.*penetration'");
  EXPECT_EQ(run(pressed + limit + stops), 0) << out;
  EXPECT_THAT(summary()["outcome"].get<std::string>(),
              testing::StartsWith("stopped as expected: tool_contact: particle 0"));
  EXPECT_EQ(run(pressed + limit + expect("outcome = \"stops\"\nmessage = \"turned inside\"")), 3);
  EXPECT_EQ(run(pressed + stops), 3);  // it reaches its end
  EXPECT_THAT(out, HasSubstr("NOT met  outcome: reached its end"));
}

TEST_F(Program, AnUnknownSeriesIsRefusedBeforeAnythingRuns) {
  EXPECT_EQ(run(pressed + expect("series = \"penetraton\"\nbelow = 1")), 2);
  EXPECT_FALSE(fs::exists(place / "run"));
}

}  // namespace
}  // namespace pulvis
