// The program as a user meets it: its exit codes, its messages, and what it leaves in a folder.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "engine/files/hdf5.hpp"
#include "tests/helpers/paths.hpp"
#include "tests/helpers/program.hpp"

namespace pulvis {
namespace {

namespace fs = std::filesystem;
using ::testing::AnyOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::MatchesRegex;
using ::testing::Not;
using ::testing::StartsWith;

class CommandLine : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    run = place / "results";
  }

  Outcome short_run(const Words& more = {}) const {
    return pulvis(ProgramTest::short_run(run.string(), more));
  }

  // A scene that is refused, in `place`.
  std::string wrong_scene() const {
    std::string text = text_of(scene("compaction/regular-25.toml"));
    text.replace(text.find("yield_stress"), 12, "yeild_stress");
    std::ofstream(place / "wrong.toml") << text;
    return (place / "wrong.toml").string();
  }

  // Every frame of the run can be read, is whole and full of finite numbers.
  void expect_whole_frames(std::size_t at_least) const {
    const auto file = hdf5::File::open(run / "run.h5");
    const auto frames = file.children("/frames");
    EXPECT_GE(frames.size(), at_least);
    for (const std::string& frame : frames) {
      const std::string group = "/frames/" + frame;
      EXPECT_EQ(file.number_attribute(group, "complete"), 1) << frame;
      auto fields = file.children(group);
      EXPECT_GE(fields.size(), 5U) << frame;
      std::ranges::replace(fields, "tools", "tools/outline");
      for (const std::string& field : fields)
        for (const double value : file.read_doubles(group + "/" + field))
          ASSERT_TRUE(std::isfinite(value)) << frame << "/" << field;
    }
  }

  fs::path run;
};

// ---- 0: done ------------------------------------------------------------------------------------
TEST_F(CommandLine, RunLeavesEveryFileItPromises) {
  const Outcome end = short_run();
  EXPECT_EQ(end.code, 0) << end.err;
  EXPECT_THAT(end.out, HasSubstr("results in " + run.string()));
  for (const char* name : {"run.h5", "run.xdmf", "run.vtkhdf", "tools.vtkhdf", "history.csv",
                           "summary.json", "report.html", "scene.toml"}) {
    EXPECT_TRUE(fs::exists(run / name)) << name;
  }
  expect_whole_frames(5);
  const auto file = hdf5::File::open(run / "run.h5");
  EXPECT_EQ(file.text_attribute("/", "outcome"), "done");
  EXPECT_EQ(file.read_doubles("/history/time").size(), 21U);
  EXPECT_DOUBLE_EQ(file.read_doubles("/history/time").back(), 20e-6);
}

TEST_F(CommandLine, SummaryHoldsTheFiguresPeopleLookUpFirst) {
  ASSERT_EQ(short_run({"--threads", "2"}).code, 0);
  const auto summary = nlohmann::json::parse(text_of(run / "summary.json"));
  for (const char* key :
       {"title", "outcome", "version", "commit", "scene_hash", "state_hash", "seed", "wall_seconds",
        "time", "element_updates_per_second", "peak_memory_bytes", "energy_balance_error",
        "relative_density", "stress_ratio/axial", "stress_ratio/lateral"}) {
    EXPECT_TRUE(summary.contains(key)) << key;
  }
  EXPECT_EQ(summary["outcome"], "done");
  EXPECT_EQ(summary["particles"], 25);
  EXPECT_EQ(summary["threads"], 2);
  EXPECT_GT(summary["steps"], 100);
  EXPECT_GT(summary["element_updates_per_second"], 0);
  EXPECT_GT(summary["peak_memory_bytes"], 1'000'000);
  ASSERT_EQ(summary["tools"].size(), 4U);
  EXPECT_EQ(summary["tools"][3]["name"], "top");
  EXPECT_EQ(summary["tools"][3]["force"].size(), 2U);
  EXPECT_NEAR(summary["tools"][3]["point"][1], 49.6e-3, 1e-12);
}

// The same series under the same names in both files: scripts rely on either.
TEST_F(CommandLine, HistoryIsHeadedByNameAndUnit) {
  ASSERT_EQ(short_run().code, 0);
  std::istringstream csv(text_of(run / "history.csv"));
  std::string header, column;
  std::getline(csv, header);
  EXPECT_THAT(header, StartsWith("time [s],tool/left/position_x [m],"));
  for (const char* series :
       {"tool/top/force_y [N]", "relative_density [-]", "energy/kinetic [J]", "energy/elastic [J]",
        "energy/plastic [J]", "energy/contact [J]", "energy/friction [J]", "energy/damping [J]",
        "energy/external [J]", "energy/balance [J]", "contacts [-]", "dt [s]"})
    EXPECT_THAT(header, HasSubstr(series));

  const auto file = hdf5::File::open(run / "run.h5");
  std::istringstream columns(header);
  std::size_t count = 0;
  while (std::getline(columns, column, ',')) {
    const std::size_t bracket = column.find(" [");
    const std::string series = "/history/" + column.substr(0, bracket);
    ASSERT_TRUE(file.contains(series)) << series;
    EXPECT_EQ(column.substr(bracket), " [" + file.text_attribute(series, "unit") + "]");
    ++count;
  }
  EXPECT_EQ(count, file.datasets_below("/history").size());
}

TEST_F(CommandLine, SceneIsKeptAsItWasRunAndRunsTheSameAgain) {
  ASSERT_EQ(short_run({"--set", "contact.friction=0.25"}).code, 0);
  const std::string kept = text_of(run / "scene.toml");
  EXPECT_THAT(kept, HasSubstr("friction = 0.25"));
  EXPECT_THAT(kept, HasSubstr("duration = \"20 us\""));
  const fs::path again = place / "again";
  ASSERT_EQ(pulvis({"run", (run / "scene.toml").string(), "-o", again.string()}).code, 0);
  EXPECT_EQ(text_of(again / "scene.toml"), kept);
  const auto file = hdf5::File::open(run / "run.h5"), other = hdf5::File::open(again / "run.h5");
  EXPECT_EQ(file.text_attribute("/", "scene_hash"), other.text_attribute("/", "scene_hash"));
  EXPECT_EQ(file.read_doubles("/history/energy/elastic"),
            other.read_doubles("/history/energy/elastic"));
}

TEST_F(CommandLine, SetChangesTheRun) {
  ASSERT_EQ(short_run({"--set", "contact.friction=0"}).code, 0);
  const auto file = hdf5::File::open(run / "run.h5");
  EXPECT_EQ(file.read_doubles("/history/energy/friction").back(), 0);
  EXPECT_EQ(file.children("/frames").size(), 5U);
}

// Options may stand before the scene: --set takes one value, not all that follow.
TEST_F(CommandLine, SceneMayFollowTheOptions) {
  const Outcome end = pulvis({"check", "--set", "contact.friction=0.2", "--set", "time.safety=0.5",
                              scene("compaction/regular-25.toml")});
  EXPECT_EQ(end.code, 0) << end.err;
}

TEST_F(CommandLine, RunWithoutAFolderGoesBelowRuns) {
  const Outcome end =
      pulvis({"run", scene("basic/oblique-impact.toml"), "--set", "stage.impact.duration=2 us",
              "--set", "output.samples=3", "--set", "output.frames=1"});
  EXPECT_EQ(end.code, 0) << end.err;
  EXPECT_TRUE(fs::exists(place / "runs" / "oblique-impact" / "summary.json"));
}

TEST_F(CommandLine, CheckCountsWhatIsThereAndWritesNothing) {
  const Outcome end = pulvis({"check", scene("compaction/regular-25.toml")});
  EXPECT_EQ(end.code, 0);
  EXPECT_THAT(end.out, HasSubstr("good: 25 particles, 4 tools, 1 stage"));
  EXPECT_THAT(end.out, ::testing::Not(HasSubstr("1 stages")));
  EXPECT_FALSE(fs::exists(place / "runs"));
}

TEST_F(CommandLine, CheckPrintsTheSceneLanguage) {
  EXPECT_EQ(pulvis({"check", "--reference", "text"}).out,
            text_of(paths::source_dir() + "/docs/scene.md"));
  EXPECT_TRUE(nlohmann::json::parse(pulvis({"check", "--reference", "schema"}).out).is_object());
}

TEST_F(CommandLine, QuietStillWarns) {
  const std::string coarse = scene("compaction-3d/one-sphere.toml");
  const Words sets{"--set", "particle.ball.mesh.divisions=2", "--set",
                   "particle.ball.mesh.rings=1"};
  for (const char* silent : {"--quiet", "--json"}) {
    Words words{"run", coarse, "-o", (place / silent).string(), silent};
    words.insert(words.end(), sets.begin(), sets.end());
    const Outcome end = pulvis(words);
    EXPECT_EQ(end.code, 0) << end.err;
    EXPECT_THAT(end.err, HasSubstr("warning: "));
    EXPECT_THAT(end.out, Not(HasSubstr("warning: ")));
  }
}

TEST_F(CommandLine, PlanListsSystemsEdgesAndColumnsWithTheirBytes) {
  const Outcome end =
      pulvis({"plan", scene("compaction/regular-25.toml"), "--set", "output.particle_stress=true"});
  EXPECT_EQ(end.code, 0);
  EXPECT_THAT(end.out, HasSubstr("internal_force"));
  EXPECT_THAT(end.out, ContainsRegex("\nsystems that only sampled steps run[^\n]*\n[^\n]*"
                                     "particle_stress, [a-z_, ]*kinetic_energy"));
  EXPECT_THAT(end.out, ContainsRegex("\nedges\n +[0-9]+ -> [0-9]+\n"));
  EXPECT_THAT(end.out, ContainsRegex("\n +node +position +2 x m +[0-9]+ B "));
  EXPECT_THAT(end.out, ContainsRegex("[1-9][0-9]+ B in total"));
  EXPECT_FALSE(fs::exists(place / "runs"));
}

TEST_F(CommandLine, PlanAsGraphvizHasAnEdgeALine) {
  const std::string dot = pulvis({"plan", "--dot", scene("compaction/regular-25.toml")}).out;
  EXPECT_THAT(dot, StartsWith("digraph step {"));
  EXPECT_THAT(dot, ContainsRegex("\n  s0 \\[label=\"tool_motion"));
  EXPECT_THAT(dot, ContainsRegex("\n  s[0-9]+ -> s[0-9]+;\n"));
  EXPECT_EQ(dot.substr(dot.size() - 2), "}\n");
}

TEST_F(CommandLine, ReportIsWrittenAnew) {
  ASSERT_EQ(short_run().code, 0);
  const std::string before = text_of(run / "report.html");
  fs::remove(run / "report.html");
  const Outcome end = pulvis({"report", run.string()});
  EXPECT_EQ(end.code, 0);
  EXPECT_EQ(end.out, (run / "report.html").string() + "\n");
  EXPECT_EQ(text_of(run / "report.html"), before);
}

TEST_F(CommandLine, EveryCommandHasHelp) {
  const Outcome all = pulvis({"--help"});
  EXPECT_EQ(all.code, 0);
  for (const char* command : {"run", "study", "check", "plan", "report"}) {
    EXPECT_THAT(all.out, HasSubstr(command));
    const Outcome one = pulvis({command, "--help"});
    EXPECT_EQ(one.code, 0) << command;
    EXPECT_THAT(one.out, ContainsRegex(std::string("[Uu]sage: .*") + command)) << command;
  }
  EXPECT_THAT(pulvis({"--version"}).out, MatchesRegex("[0-9]+\\.[0-9]+\\.[0-9]+ \\(.+\\)\n"));
}

// ---- 2: bad usage, refused scene ----------------------------------------------------------------
TEST_F(CommandLine, BadUsageIsRefused) {
  const std::string good = scene("compaction/regular-25.toml");
  for (const Words& wrong : std::vector<Words>{{},
                                               {"dance"},
                                               {"run"},
                                               {"run", good, "--colour"},
                                               {"run", good, "--threads", "0"},
                                               {"run", good, "--threads", "two"},
                                               {"run", good, "--stop-after", "0"},
                                               {"run", good, "--stop-after", "3s"},
                                               {"run", good, "--checkpoint-every", "nan"},
                                               {"run", good, "-o"},
                                               {"check"},
                                               {"check", "--reference", "poem"},
                                               {"report"},
                                               {"study"},
                                               {"study", good, "--jobs", "0"},
                                               {"study", "--reference", "poem"}}) {
    const Outcome end = pulvis(wrong);
    EXPECT_EQ(end.code, 2) << ::testing::PrintToString(wrong);
    EXPECT_THAT(end.err, HasSubstr("--help")) << ::testing::PrintToString(wrong);
    EXPECT_LT(end.err.size(), 200U) << end.err;
  }
  EXPECT_FALSE(fs::exists(place / "runs"));
}

TEST_F(CommandLine, WrongSceneIsRefusedAtItsLineAndColumn) {
  const std::string file = wrong_scene();
  for (const Words& command :
       std::vector<Words>{{"run", file, "-o", run.string()}, {"check", file}, {"plan", file}}) {
    const Outcome end = pulvis(command);
    EXPECT_EQ(end.code, 2) << command[0];
    EXPECT_THAT(end.err, ContainsRegex("^" + file + ":17:1: material\\[0\\]\\.yeild_stress: "));
    EXPECT_THAT(end.err, HasSubstr("did you mean 'yield_stress'?"));
    EXPECT_EQ(end.out, "");
  }
  EXPECT_FALSE(fs::exists(run));
}

// Everything that can be refused is refused before there is a folder.
TEST_F(CommandLine, RefusalLeavesNoFolder) {
  const std::string good = scene("compaction/regular-25.toml");
  for (const std::string wrong :
       {"contact.friction=-1", "contact.frictoin=0.1", "friction", "packing[0].columns=6",
        "stage.press.duration=3 kg", "packing[0].rows=0"}) {
    const Outcome end = pulvis({"run", good, "-o", run.string(), "--set", wrong});
    EXPECT_EQ(end.code, 2) << wrong << end.err;
    EXPECT_FALSE(fs::exists(run)) << wrong;
  }
  EXPECT_EQ(pulvis({"run", (place / "none.toml").string(), "-o", run.string()}).code, 2);
  EXPECT_FALSE(fs::exists(run));
}

TEST_F(CommandLine, AFileOfAnotherKindNamesTheCommandThatReadsIt) {
  const std::string scenes = paths::source_dir() + "/scenes/";
  const auto said = [&](const std::string& command, const std::string& file) {
    const Outcome end = pulvis({command, scenes + file});
    EXPECT_EQ(end.code, 2);
    return end.err;
  };
  EXPECT_THAT(said("run", "studies/particle-size.toml"), HasSubstr("allowed: pulvis study "));
  EXPECT_THAT(said("check", "lab/reduce.toml"), HasSubstr("allowed: pulvis reduce "));
  EXPECT_THAT(said("run", "lab/plate-fit.toml"), HasSubstr("allowed: pulvis fit "));
  for (const char* command : {"study", "probe", "fit", "reduce"})
    EXPECT_THAT(said(command, "compaction/regular-25.toml"), HasSubstr("allowed: pulvis run "));
  EXPECT_THAT(pulvis({"rnu"}).err, HasSubstr("there is no command 'rnu', did you mean 'run'?"));
}

TEST_F(CommandLine, TakenFolderIsRefusedAndStaysAsItWas) {
  ASSERT_EQ(short_run().code, 0);
  const std::string history = text_of(run / "history.csv");
  const std::string scene_before = text_of(run / "scene.toml");
  const Outcome end = short_run({"--set", "contact.friction=0.3"});
  EXPECT_EQ(end.code, 2);
  EXPECT_THAT(end.err, HasSubstr(run.string()));
  EXPECT_THAT(end.err, HasSubstr("already holds one"));
  EXPECT_THAT(end.err, HasSubstr("--overwrite"));
  EXPECT_EQ(text_of(run / "history.csv"), history);
  EXPECT_EQ(text_of(run / "scene.toml"), scene_before);

  EXPECT_EQ(short_run({"--set", "contact.friction=0.3", "--overwrite"}).code, 0);
  EXPECT_THAT(text_of(run / "scene.toml"), HasSubstr("friction = 0.3"));
  EXPECT_NE(text_of(run / "history.csv"), history);
}

// ---- 3: the run failed ------------------------------------------------------------------------
// A punch at 900 m/s goes through the particles.
TEST_F(CommandLine, RunGoneBadNamesTheCulpritAndKeepsWhatWasBefore) {
  const Outcome end = short_run({"--set", "stage.press.move[0].displacement=[\"0 mm\", \"-18 mm\"]",
                                 "--set", "output.frames=40", "--set", "output.samples=80", "--set",
                                 "limits.energy_balance=100"});
  EXPECT_EQ(end.code, 3);
  EXPECT_THAT(end.err, HasSubstr("the run failed"));
  EXPECT_THAT(end.err, HasSubstr(run.string()));
  EXPECT_THAT(
      end.err,
      ContainsRegex("(edge_contact|tool_contact|trial_stress|outline_health): particle [0-9]+.* "
                    "(edge|element|node) [0-9]+"));
  EXPECT_THAT(
      end.err,
      ContainsRegex("(penetration [0-9.e+-]+ m|[0-9.e+-]+ m inside|det F = [0-9.e+-]+|closest "
                    "point was not found)"));
  EXPECT_THAT(end.err, ContainsRegex("step [0-9]+, t = [0-9.e+-]+ s"));
  expect_whole_frames(2);
  const auto file = hdf5::File::open(run / "run.h5");
  const std::string outcome = file.text_attribute("/", "outcome");
  EXPECT_THAT(outcome, StartsWith("failed: "));
  EXPECT_GE(file.read_doubles("/history/time").size(), 2U);
  const auto summary = nlohmann::json::parse(text_of(run / "summary.json"));
  EXPECT_EQ(summary["outcome"], outcome);
  EXPECT_TRUE(fs::exists(run / "report.html"));
}

TEST_F(CommandLine, AQuietRunTellsWhichExpectationIsNotMet) {
  const std::string expecting = (place / "expecting.toml").string();
  std::ofstream(expecting) << text_of(scene("compaction/regular-25.toml"))
                           << "[[expect]]\nseries = \"energy_balance_error\"\nbelow = 1e-300\n"
                              "[[expect]]\nseries = \"energy_balance_error\"\nbelow = 1.0\n";
  for (const char* silent : {"--quiet", "--json"}) {
    const Outcome end = pulvis(with({"run", expecting, "-o", run, silent, "--overwrite"}, quick()));
    EXPECT_EQ(end.code, 3) << end.err;
    EXPECT_THAT(end.err, HasSubstr("pulvis: expectation NOT met  energy_balance_error"));
    EXPECT_THAT(end.err, Not(HasSubstr("expectation met")));
  }
}

// Before the first sample there is nothing to keep, but the message and the code are the same. The block
// stands a hair too low: not enough to be refused, enough to pass this limit at once.
TEST_F(CommandLine, RunThatIsBadFromTheStartSaysSoToo) {
  const Outcome end = pulvis({"run", scene("basic/patch-test.toml"), "-o", run.string(), "--set",
                              "body[0].position=[\"5 mm\", \"2.499999999 mm\"]", "--set",
                              "limits.penetration=1e-12"});
  EXPECT_EQ(end.code, 3) << end.err;
  EXPECT_THAT(end.err,
              ContainsRegex("tool_contact: particle 0, edge [0-9]+ against tool '[a-z]+': "));
  EXPECT_THAT(end.err, HasSubstr("at step 0,"));
  EXPECT_TRUE(fs::exists(run / "summary.json"));
}

// ---- 4: the machine -----------------------------------------------------------------------------
TEST_F(CommandLine, UnwritableFolderIsTheMachinesFault) {
  std::ofstream(place / "file") << "no folder\n";
  for (const fs::path& where : {place / "file" / "run", place / "file", fs::path("/proc/run")}) {
    const Outcome end = pulvis({"run", scene("basic/oblique-impact.toml"), "-o", where.string()});
    EXPECT_EQ(end.code, 4) << where << end.err;
    EXPECT_THAT(end.err, StartsWith(where.string() + ": cannot ")) << end.err;
  }
  EXPECT_EQ(text_of(place / "file"), "no folder\n");
}

TEST_F(CommandLine, ReportsAreOfRuns) {
  fs::create_directories(place / "study");
  std::ofstream(place / "study" / "study.toml") << "\n";
  for (const auto& [folder, says] : {std::pair{"nothing", "no such folder"},
                                     {"study", "is the folder of a study"},
                                     {".", "holds no run: there is no run.h5"}}) {
    const Outcome end = pulvis({"report", (place / folder).string()});
    EXPECT_EQ(end.code, 2) << folder;
    EXPECT_THAT(end.err, HasSubstr(says));
  }
}

// ---- 130: interrupted ---------------------------------------------------------------------------
// The spinning disc would take minutes; the first frames are there long before.
TEST_F(CommandLine, InterruptEndsBetweenTwoStepsWithReadableResults) {
  for (const int signal : {SIGINT, SIGTERM, SIGUSR1}) {
    fs::remove_all(run);
    const pid_t child =
        start({"run", scene("basic/spinning-disc.toml"), "-o", run.string(), "--threads", "1",
               "--set", "output.frames=10000", "--set", "output.samples=20000"});
    for (int tries = 0;
         tries < 3000 && text_of(run / "run.xdmf").find("000002") == std::string::npos; ++tries) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    kill(child, signal);
    const Outcome end = end_of(child);
    EXPECT_EQ(end.code, 130) << end.err;
    expect_whole_frames(2);
    const auto file = hdf5::File::open(run / "run.h5");
    EXPECT_EQ(file.text_attribute("/", "outcome"), "interrupted");
    EXPECT_EQ(nlohmann::json::parse(text_of(run / "summary.json"))["outcome"], "interrupted");
  }
}

// What pack writes, a scene reads back: the same packing, written again, is the same text but for its head.
TEST_F(CommandLine, PackWritesWhatAPackingReads) {
  const Outcome made = pulvis({"pack", scene("compaction/random-100.toml"), "-o", "packing.csv"});
  EXPECT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.out,
              ContainsRegex("packing\\[0\\]: 100 particles, relative density 0.7000, die "));
  EXPECT_THAT(made.out, HasSubstr("packing.csv: 100 particles"));
  const std::string table = text_of(place / "packing.csv");
  EXPECT_THAT(table, StartsWith("# Packing of random-100.toml, seed 1\n# random: 100 particles"));
  std::ofstream(place / "again.toml")
      << "extends = \"" << scene("compaction/random-100.toml") << "\"\n"
      << "packing = [{ kind = \"csv\", file = \"packing.csv\" }]\n";
  EXPECT_EQ(pulvis({"pack", "again.toml", "-o", "again.csv"}).code, 0);
  const auto rows = [](const std::string& text) { return text.substr(text.find("# top:")); };
  EXPECT_EQ(rows(text_of(place / "again.csv")), rows(table));
}

TEST_F(CommandLine, PackRefusesADensityOutOfReach) {
  const Outcome outcome = pulvis({"pack", scene("compaction/random-100.toml"), "--set",
                                  "packing[0].density=0.95", "-o", "packing.csv"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, ContainsRegex("0.9500 cannot be reached: .*allowed: at most 0.8"));
  EXPECT_FALSE(fs::exists(place / "packing.csv"));
}

}  // namespace
}  // namespace pulvis
