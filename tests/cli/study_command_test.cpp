// pulvis study as a user meets it: what it leaves, what it runs again, and what one bad run costs.
#include <gmock/gmock.h>

#include <chrono>
#include <csignal>
#include <functional>
#include <nlohmann/json.hpp>
#include <thread>

#include "tests/helpers/program.hpp"

namespace pulvis {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

class StudyCommand : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    results = place / "results";
  }

  // 25 particles for some 250 steps a run, `duration` longer where it must be caught at work.
  void write(const std::string& frictions, const std::string& more = "",
             const std::string& duration = "20 us") const {
    std::ofstream(place / "study.toml")
        << "scene = \"" << scene("compaction/regular-25.toml") << "\"\n[set]\n"
        << "\"stage.press.duration\" = \"" << duration << "\"\n"
        << "\"stage.press.move[0].displacement\" = [\"0 mm\", \"-0.4 mm\"]\n"
        << "output.frames = 2\noutput.samples = 40\n[grid]\ncontact.friction = " << frictions
        << "\n"
        << more;
  }

  Words command(const Words& more = {}, const char* jobs = "2") const {
    Words words{"study", (place / "study.toml").string(), "-o", results.string(), "--jobs", jobs};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  Outcome study(const Words& more = {}) const { return pulvis(command(more)); }

  nlohmann::json summary(const fs::path& folder) const {
    return nlohmann::json::parse(text_of(folder / "summary.json"));
  }

  static bool comes(const std::function<bool()>& condition) {
    for (int tries = 0; tries < 3000 && !condition(); ++tries)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return condition();
  }

  static std::vector<pid_t> children_of(pid_t parent) {
    std::istringstream text(text_of("/proc/" + std::to_string(parent) + "/task/" +
                                    std::to_string(parent) + "/children"));
    return {std::istream_iterator<pid_t>(text), {}};
  }

  fs::path results;
};

TEST_F(StudyCommand, LeavesTableCurvesReportAndOrdinaryRuns) {
  write("[0.1, 0.2, 0.3]", R"([[expect]]
series = "energy/friction"
order = ["friction=0.1", "friction=0.2", "friction=0.3"]
trend = "increasing"
)");
  const Outcome end = study();
  EXPECT_EQ(end.code, 0) << end.out << end.err;
  EXPECT_THAT(end.out, HasSubstr("met      energy/friction, at the end: "));
  EXPECT_THAT(end.out, HasSubstr("3 of 3 runs good"));
  for (const char* name : {"study.toml", "study.csv", "summary.json", "curves.json", "report.html"})
    EXPECT_TRUE(fs::exists(results / name)) << name;
  for (const char* run : {"friction=0.1", "friction=0.2", "friction=0.3"})
    for (const char* name : {"run.h5", "history.csv", "summary.json", "report.html", "log.txt"})
      EXPECT_TRUE(fs::exists(results / run / name)) << run << "/" << name;

  std::istringstream csv(text_of(results / "study.csv"));
  std::string line;
  std::getline(csv, line);
  EXPECT_THAT(line, ::testing::StartsWith("run,variation,scene,seed,contact.friction,outcome,"));
  const auto columns = std::ranges::count(line, ',');
  int rows = 0;
  for (; std::getline(csv, line); ++rows) EXPECT_EQ(std::ranges::count(line, ','), columns) << line;
  EXPECT_EQ(rows, 3);

  const auto json = summary(results);
  EXPECT_EQ(json["runs"].size(), 3U);
  EXPECT_EQ(json["runs"][1]["varied"]["contact.friction"], "0.2");
  EXPECT_TRUE(json["expectations"][0]["met"]);
  const auto curves = nlohmann::json::parse(text_of(results / "curves.json"));
  EXPECT_EQ(curves[0]["lines"].size(), 3U);
  EXPECT_GT(curves[0]["lines"][0]["x"].size(), 30U);
}

// Calibrations of a beam: bending stiffness goes as the cube of the thickness, the closed form's answer is beside.
TEST_F(StudyCommand, LeversHaveFiguresAndSensitivities) {
  const auto write_study = [&](const std::string& more) {
    std::ofstream(place / "study.toml")
        << "scene = \"" << scene("afm/calibration-beam.toml") << R"("
[grid]
lever.thickness = ["2 um", "2.2 um", "2.4 um"]
[[fit]]
law = "power"
series = "k_n"
key = "lever.thickness"
)" << more;
  };
  write_study(
      "above = 2.9\nbelow = 3.1\n[[expect]]\nseries = \"k_n/beam\"\nof = "
      "\"thickness=2um\"\nequals = 1\nwithin = 0.05\n");
  const Outcome end = study();
  EXPECT_EQ(end.code, 0) << end.out << end.err;
  EXPECT_THAT(end.out, HasSubstr("met      exponent of k_n against lever.thickness, of all runs"));
  const auto json = summary(results);
  EXPECT_EQ(json["expectations"].size(), 2U);
  const auto& fit = json["fits"][0];
  EXPECT_EQ(fit["key_unit"], "m");
  EXPECT_NEAR(fit["groups"][0]["points"][1]["key"].get<double>(), 2.2e-6, 1e-18);
  // The figure is that of the run's own calibration.
  const auto run = summary(results / "thickness=2.2um");
  EXPECT_EQ(fit["groups"][0]["points"][1]["value"], run["calibration"]["k_n"]);
  EXPECT_EQ(run["values"]["k_l"], run["calibration"]["k_l"]);
  const std::string csv = text_of(results / "study.csv");
  EXPECT_THAT(csv, HasSubstr(",k_n [N/m],k_l [N/m],k_l/k_n [-],"));
  EXPECT_TRUE(run["values"].contains("k_l/torsion_and_bending"));
  for (const auto& figure : run["values"].items())
    EXPECT_THAT(csv, HasSubstr("," + figure.key() + " [")) << "is no column";
  EXPECT_EQ(std::ranges::count(text_of(results / "sensitivities.csv"), '\n'), 1 + 3);
  EXPECT_FALSE(fs::exists(results / "strengths.csv"));

  write_study("above = -1\nbelow = 1\n");  // what is finished is not run again
  const Outcome again = study();
  EXPECT_EQ(again.code, 3);
  EXPECT_THAT(again.out, HasSubstr("0 to do, 3 finished before"));
  EXPECT_THAT(again.out, HasSubstr("NOT met"));
}

TEST_F(StudyCommand, WhatNoLeverHasIsRefused) {
  const auto refused = [&](const std::string& grid, const std::string& more) {
    std::ofstream(place / "study.toml")
        << "scene = \"" << scene("afm/calibration-beam.toml") << "\"\n[grid]\n"
        << grid << "\n"
        << more;
    const Outcome end = study();
    EXPECT_EQ(end.code, 2) << end.out;
    EXPECT_FALSE(fs::exists(results));
    return end.err;
  };
  const std::string heights = "tip.height = [\"10 um\", \"12 um\"]";
  EXPECT_THAT(refused(heights,
                      "[[fit]]\nlaw = \"power\"\nseries = \"loop/friction\"\nkey = "
                      "\"tip.height\"\n"),
              HasSubstr("has no series 'loop/friction'"));
  EXPECT_THAT(refused(heights,
                      "[[fit]]\nlaw = \"power\"\nseries = \"k_l\"\nkey = "
                      "\"tip.hight\"\n"),
              HasSubstr("the study does not vary 'tip.hight'"));
  EXPECT_THAT(refused("tip.offset = [\"0 um\", \"2 um\"]",
                      "[[fit]]\nlaw = \"power\"\nseries = \"k_l\"\nkey = \"tip.offset\"\n"),
              HasSubstr("'tip.offset' is not a number above 0"));
  EXPECT_THAT(refused(heights,
                      "[[expect]]\nseries = \"k_l\"\nwhen = \"max\"\nof = "
                      "\"height=10um\"\nabove = 1\n"),
              HasSubstr("'k_l' is one value of the whole run"));
  EXPECT_THAT(refused(heights, "[[curve]]\ny = \"k_l\"\nx = \"actions\"\n"),
              HasSubstr("no run has the series 'k_l'"));
}

// Meshes that are turned by chance make the forces of the seeds differ.
TEST_F(StudyCommand, LeavesLawsOfStrength) {
  std::ofstream(place / "study.toml") << "scene = \"" << scene("compaction/regular-25.toml") << R"("
seeds = [1, 2, 3, 4, 5]
[set]
"stage.press.duration" = "20 us"
particle.disc.mesh.phase = "random"
output.frames = 2
output.samples = 40
[[variation]]
name = "little"
set = { "stage.press.move[0].displacement" = ["0 mm", "-0.3 mm"] }
[[variation]]
name = "more"
set = { "stage.press.move[0].displacement" = ["0 mm", "-0.4 mm"] }
[[fit]]
law = "weibull"
series = "tool/top/force_y"
when = "max"
disc = "disc"
[[fit]]
law = "ryshkewitch_duckworth"
title = "Pressure"
series = "pressure/top"
when = "max"
)";
  const Outcome end = study();
  ASSERT_EQ(end.code, 0) << end.out << end.err;
  EXPECT_THAT(end.out, HasSubstr("Weibull's law: tool/top/force_y, largest\n  little: modulus "));
  const auto json = summary(results);
  const auto& fits = json["fits"];
  ASSERT_EQ(fits.size(), 2U);
  const auto& points = fits[0]["groups"][1]["points"];
  ASSERT_EQ(points.size(), 5U);
  EXPECT_EQ(points[0]["failure_probability"], 0.1);
  EXPECT_LT(points[0]["strength"], points[4]["strength"]);
  // The strengths are the table's forces over pi D t/2.
  double largest = 0;
  for (const auto& run : json["runs"])
    for (const auto& figure : run["values"])
      if (run["variation"] == "more" && figure["name"] == "top_force_max")
        largest = std::max(largest, figure["value"].get<double>());
  EXPECT_NEAR(points[4]["strength"].get<double>() * 3.14159265358979 * 0.01 * 1e-3 / 2, largest,
              1e-9 * largest);
  EXPECT_EQ(fits[0]["groups"][0]["parameters"][0]["name"], "modulus");
  EXPECT_FALSE(fits[0].contains("size_effect"));  // one size
  EXPECT_EQ(fits[1]["groups"][0]["points"].size(), 10U);
  EXPECT_LT(fits[1]["groups"][0]["points"][0]["porosity"], 0.22);
  EXPECT_EQ(std::ranges::count(text_of(results / "fits.csv"), '\n'), 1 + 3 + 3 + 3);
  EXPECT_EQ(std::ranges::count(text_of(results / "strengths.csv"), '\n'), 1 + 10 + 10);
  // The same study without laws leaves none.
  const std::string text = text_of(place / "study.toml");
  std::ofstream(place / "study.toml") << text.substr(0, text.find("[[fit]]"));
  ASSERT_EQ(study().code, 0);
  EXPECT_FALSE(fs::exists(results / "fits.csv"));
  EXPECT_FALSE(fs::exists(results / "strengths.csv"));
}

TEST_F(StudyCommand, StrengthsThatAreAlikeAreNotFitted) {
  write("[0.1]", "[[fit]]\nlaw = \"weibull\"\nseries = \"tool/top/force_y\"\nwhen = \"max\"\n");
  const std::string text = text_of(place / "study.toml");
  std::ofstream(place / "study.toml") << "seeds = [1, 2, 3, 4, 5]\n" << text;
  const Outcome end = study();
  EXPECT_EQ(end.code, 0) << end.err;
  EXPECT_THAT(end.out, HasSubstr("friction=0.1: not fitted: all strengths are equal"));
}

TEST_F(StudyCommand, RunsOnlyWhatIsMissingOrChanged) {
  write("[0.1, 0.2]");
  ASSERT_EQ(study().code, 0);
  const std::string before = text_of(results / "friction=0.1" / "summary.json");
  EXPECT_THAT(study().out, HasSubstr("2 runs: 0 to do, 2 finished before"));
  write("[0.1, 0.2, 0.3]");
  EXPECT_THAT(study().out, HasSubstr("3 runs: 1 to do, 2 finished before"));
  EXPECT_EQ(text_of(results / "friction=0.1" / "summary.json"), before);
  write("[0.1, 0.2, 0.3]", "", "21 us");
  EXPECT_THAT(study().out, HasSubstr("3 runs: 3 to do, 0 finished before"));
  EXPECT_THAT(study({"--fresh"}).out, HasSubstr("3 runs: 3 to do"));
  EXPECT_THAT(study({"--set", "contact.damping=0.2"}).out, HasSubstr("3 runs: 3 to do"));
}

// Spread over seeds: three runs of what knows no chance are one curve with an empty band.
TEST_F(StudyCommand, SeedsMakeABandAboutTheirMean) {
  write("[0.1]");
  const std::string text = text_of(place / "study.toml");
  std::ofstream(place / "study.toml") << "seeds = [1, 2, 3]\n" << text;
  ASSERT_EQ(study().code, 0);
  const auto curves = nlohmann::json::parse(text_of(results / "curves.json"));
  const auto& line = curves[0]["lines"][0];
  EXPECT_EQ(line["variation"], "friction=0.1");
  EXPECT_EQ(line["runs"], 3);
  EXPECT_EQ(line["low"], line["high"]);
  EXPECT_EQ(line["low"].size(), line["x"].size());
  EXPECT_TRUE(fs::exists(results / "friction=0.1,seed=3" / "run.h5"));
}

// A target rests until its stage begins: the band goes from there over its whole way.
TEST_F(StudyCommand, SeedsMakeABandOverADistanceThatRestsFirst) {
  std::ofstream(place / "study.toml")
      << "scene = \"" << scene("studies/scenes/shear-regular.toml") << "\"\nseeds = [1, 2]\n[set]\n"
      << "stage.load.duration = \"10 us\"\nstage.shear.duration = \"10 us\"\n"
      << "stage.load.servo.top.tolerance = 1e6\n"
      << "stage.shear.move.target.displacement = [\"0.01 mm\", \"0 mm\"]\n"
      << "output.frames = 2\noutput.samples = 40\n"
      << "[[curve]]\nx = \"shear/distance\"\ny = \"shear/work\"\n";
  const Outcome end = study();
  ASSERT_EQ(end.code, 0) << end.out << end.err;
  const auto curves = nlohmann::json::parse(text_of(results / "curves.json"));
  ASSERT_EQ(curves[0]["lines"].size(), 1U);
  const auto& x = curves[0]["lines"][0]["x"];
  EXPECT_EQ(x.front(), 0);
  EXPECT_NEAR(x.back().get<double>(), 0.01e-3, 1e-9);
}

// A punch that goes through the particles costs its own run, and what was expected of it.
TEST_F(StudyCommand, OneRunThatGoesBadCostsNoOther) {
  std::ofstream(place / "study.toml")
      << "scene = \"" << scene("compaction/regular-25.toml") << "\"\n[set]\n"
      << "\"stage.press.duration\" = \"20 us\"\nlimits.energy_balance = 100\noutput.frames = 2\n"
      << "output.samples = 40\n[grid]\n\"stage.press.move[0].displacement\" = "
      << "[[\"0 mm\", \"-20 mm\"], [\"0 mm\", \"-0.4 mm\"], [\"0 mm\", \"-0.3 mm\"]]\n"
      << "[[expect]]\nseries = \"energy/external\"\nof = \"displacement=0mm_-20mm\"\nabove = 0\n";
  const Outcome end = study();
  EXPECT_EQ(end.code, 3);
  EXPECT_THAT(end.err, HasSubstr("displacement=0mm_-20mm: failed: "));
  EXPECT_THAT(end.out, HasSubstr("NOT met  energy/external, at the end, of displacement"));
  EXPECT_THAT(end.out, HasSubstr("2 of 3 runs good"));
  EXPECT_EQ(summary(results / "displacement=0mm_-0.3mm")["outcome"], "done");
  EXPECT_THAT(text_of(results / "study.csv"), HasSubstr("failed: "));
  EXPECT_TRUE(fs::exists(results / "report.html"));
  const Outcome again =
      study();  // the same bits would go bad again: it is not run, and not forgotten
  EXPECT_THAT(again.out, HasSubstr("0 to do, 3 finished before"));
  EXPECT_EQ(again.code, 3);
}

TEST_F(StudyCommand, ACrashedRunIsToldAndRunAgain) {
  write("[0.1, 0.2]", "", "400 us");
  const pid_t program = start(command());
  ASSERT_TRUE(comes([&] { return children_of(program).size() == 2; }));
  kill(children_of(program).front(), SIGKILL);
  const Outcome end = end_of(program);
  EXPECT_EQ(end.code, 3);
  EXPECT_THAT(end.out, HasSubstr("BAD: crashed: signal 9"));
  EXPECT_THAT(end.out, HasSubstr("1 of 2 runs good"));
  const Outcome again = study();
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_THAT(again.out, HasSubstr("2 runs: 1 to do, 1 finished before"));
}

// The study dies; its children go with it, and the next one takes up what was left.
TEST_F(StudyCommand, AKilledStudyGoesOnWhereItWas) {
  write("[0.1, 0.2, 0.3]", "", "400 us");
  const pid_t program = start(command({}, "1"));
  ASSERT_TRUE(comes([&] { return fs::exists(results / "friction=0.2" / "run.h5"); }));
  const std::vector<pid_t> children = children_of(program);
  ASSERT_EQ(children.size(), 1U);
  kill(program, SIGKILL);
  EXPECT_EQ(end_of(program).code, 128 + SIGKILL);
  EXPECT_TRUE(comes([&] {
    const std::string state = text_of("/proc/" + std::to_string(children[0]) + "/stat");
    return state.empty() || state.find(") Z") != std::string::npos;
  })) << "the child still runs";
  const std::string first = text_of(results / "friction=0.1" / "summary.json");
  const Outcome end = study();
  EXPECT_EQ(end.code, 0) << end.err;
  EXPECT_THAT(end.out, HasSubstr("3 runs: 2 to do, 1 finished before"));
  EXPECT_EQ(text_of(results / "friction=0.1" / "summary.json"), first);
}

TEST_F(StudyCommand, InterruptStopsCleanly) {
  write("[0.1, 0.2, 0.3]", "", "2 ms");
  const pid_t program = start(command());
  ASSERT_TRUE(comes([&] { return fs::exists(results / "friction=0.1" / "run.h5"); }));
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  kill(program, SIGINT);
  const Outcome end = end_of(program);
  EXPECT_EQ(end.code, 130);
  EXPECT_THAT(end.err, HasSubstr("run the same command again to continue"));
  EXPECT_EQ(summary(results / "friction=0.1")["outcome"], "interrupted");
  EXPECT_FALSE(fs::exists(results / "friction=0.3"));
  EXPECT_FALSE(fs::exists(results / "report.html"));
}

// Not only runs that are missing: what of one was done is not done again, and its bits are those of a run
// that nobody stopped.
TEST_F(StudyCommand, AnInterruptedRunGoesOnAtItsCheckpoint) {
  write("[0.1]", "", "400 us");
  const pid_t program = start(command());
  ASSERT_TRUE(comes([&] { return fs::exists(results / "friction=0.1" / "run.h5"); }));
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  kill(program, SIGINT);
  ASSERT_EQ(end_of(program).code, 130);
  const auto stopped = summary(results / "friction=0.1");
  ASSERT_EQ(stopped["outcome"], "interrupted");

  const Outcome rest = study();
  EXPECT_EQ(rest.code, 0) << rest.err;
  EXPECT_THAT(rest.out, HasSubstr("interrupted before, resumed from their checkpoints: 1\n"));
  EXPECT_THAT(text_of(results / "friction=0.1" / "log.txt"),
              HasSubstr("resumed at step " + stopped["steps"].dump() + ","));
  const auto ended = summary(results / "friction=0.1");
  const std::string history = text_of(results / "friction=0.1" / "history.csv");
  const Outcome fresh = study({"--fresh"});
  EXPECT_THAT(fresh.out, Not(HasSubstr("broken off")));
  EXPECT_EQ(summary(results / "friction=0.1")["state_hash"], ended["state_hash"]);
  EXPECT_EQ(text_of(results / "friction=0.1" / "history.csv"), history);
}

// The scene is another one now: its run begins anew instead of going on with the old one.
TEST_F(StudyCommand, AnInterruptedRunOfAnotherSceneDoesNotGoOn) {
  write("[0.1]", "", "2 ms");
  const pid_t program = start(command());
  ASSERT_TRUE(comes([&] { return fs::exists(results / "friction=0.1" / "run.h5"); }));
  kill(program, SIGINT);
  ASSERT_EQ(end_of(program).code, 130);
  write("[0.1]");
  const Outcome end = study();
  EXPECT_EQ(end.code, 0) << end.err;
  EXPECT_THAT(end.out, Not(HasSubstr("broken off")));
  EXPECT_EQ(summary(results / "friction=0.1")["outcome"], "done");
}

TEST_F(StudyCommand, TwoInOneFolderAreRefused) {
  write("[0.1]", "", "2 ms");
  const pid_t first = start(command());
  ASSERT_TRUE(comes([&] { return fs::exists(results / "friction=0.1" / "run.h5"); }));
  const Outcome second = study();
  EXPECT_EQ(second.code, 2);
  EXPECT_THAT(second.err, HasSubstr("another study is running in it"));
  kill(first, SIGINT);
  EXPECT_EQ(end_of(first).code, 130);
}

TEST_F(StudyCommand, WrongStudyIsRefusedBeforeAnythingIsMade) {
  write("[0.1, -1]");
  const Outcome end = study();
  EXPECT_EQ(end.code, 2);
  EXPECT_THAT(end.err, HasSubstr("study.toml:8:26: contact.friction: -1 is out of range"));
  EXPECT_FALSE(fs::exists(results));
  write("[0.1, 0.2]");
  const Outcome list = study({"--list"});
  EXPECT_EQ(list.code, 0) << list.err;
  EXPECT_THAT(list.out, HasSubstr("good: 2 runs of 2 variations"));
  EXPECT_FALSE(fs::exists(results));
}

// A packing that does not fit is found when it is placed, by the run itself.
TEST_F(StudyCommand, ARunThatIsRefusedSaysWhy) {
  write("[0.1]",
        "[[variation]]\nname = \"fits\"\n[[variation]]\nname = \"wide\"\n"
        "set = { \"packing[0].columns\" = 6 }\n");
  const Outcome end = study();
  EXPECT_EQ(end.code, 3);
  EXPECT_THAT(end.err, HasSubstr("wide,friction=0.1: exit code 2: "));
  EXPECT_THAT(end.out, HasSubstr("1 of 2 runs good"));
}

}  // namespace
}  // namespace pulvis
