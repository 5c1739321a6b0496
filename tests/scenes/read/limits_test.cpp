// What the program bears from its user and its machine: signals at any time, inputs that are no files, words that
// are none, files that vanish, disks that are full.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <thread>

#include "cli/csv_cell.hpp"
#include "engine/files/hdf5.hpp"
#include "scenes/expectations.hpp"
#include "scenes/language/units.hpp"
#include "scenes/memory_need.hpp"
#include "scenes/read.hpp"
#include "tests/helpers/program.hpp"

namespace pulvis {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class Limits : public ProgramTest {
 protected:
  // A program that does not end would keep the test waiting: after a minute it counts as one that hangs.
  Outcome end_or_hang(pid_t child) const {
    for (int i = 0; i < 1200; ++i) {
      siginfo_t info{};
      if (waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
          info.si_pid == child)
        return end_of(child);
      std::this_thread::sleep_for(50ms);
    }
    ADD_FAILURE() << "it hangs";
    kill(child, SIGKILL);
    return end_of(child);
  }

  Outcome patient(const Words& arguments, const std::string& shell = "") const {
    return end_or_hang(start(arguments, shell));
  }

  void wait_for(const fs::path& file, pid_t child) const {
    for (int i = 0; i < 1200 && !fs::exists(file); ++i) {
      ASSERT_EQ(kill(child, 0), 0);
      std::this_thread::sleep_for(50ms);
    }
    ASSERT_TRUE(fs::exists(file));
  }

  std::string fifo(const std::string& name) const {
    EXPECT_EQ(mkfifo((place / name).c_str(), 0600), 0);
    return (place / name).string();
  }
};

// ---- signals ----------------------------------------------------------------------------------------
TEST_F(Limits, SignalsEndARandomPackingBeforeAnythingIsWritten) {
  const Words words{"run",   scene("compaction/random-100.toml"),
                    "-o",    "run",
                    "--set", "packing[0].class[0].number=4000",
                    "--set", "packing[0].width=600 mm",
                    "--set", "packing[0].density=0.84"};
  for (const int signal : {SIGINT, SIGTERM}) {
    const pid_t child = start(words);
    std::this_thread::sleep_for(700ms);
    kill(child, signal);
    const Outcome end = end_or_hang(child);
    EXPECT_EQ(end.code, 130) << end.err;
    EXPECT_THAT(end.err, HasSubstr("nothing was written"));
    EXPECT_FALSE(fs::exists(place / "run"));
  }
}

TEST_F(Limits, SignalsEndALargeFactorisation) {
  const pid_t child = start({"run", scene("afm/tipless-beam.toml"), "-o", "run", "--set",
                             "lever.elements_along=120", "--set", "lever.elements_across=90",
                             "--set", "lever.layers=2"});
  std::this_thread::sleep_for(2s);
  kill(child, SIGTERM);
  const Outcome end = end_or_hang(child);
  EXPECT_EQ(end.code, 130) << end.err;
  EXPECT_FALSE(fs::exists(place / "run"));
}

// Whatever increment the signal hits, half way to its equilibrium or not: the run goes on to the same bits.
TEST_F(Limits, ALeversRunGivenUpHalfWayGoesOnToTheSameBits) {
  const auto hash = [&](const char* folder) {
    return nlohmann::json::parse(text_of(place / folder / "summary.json"))["state_hash"];
  };
  const Words programme{
      "run",   scene("afm/loop-beam-0.toml"), "--set",     "lever.elements_along=8",
      "--set", "lever.elements_across=4",     "--set",     "tip.elements=2",
      "--set", "action[1].increments=60",     "--threads", "1",
      "-o"};
  Words words = programme;
  words.push_back("whole");
  ASSERT_EQ(pulvis(words).code, 0);
  words.back() = "given-up";
  int stops = 0;
  pid_t child = start(words);
  wait_for(place / "given-up" / "run.h5", child);
  for (; stops < 2; ++stops) {
    std::this_thread::sleep_for(60ms);
    kill(child, SIGINT);
    const Outcome end = end_or_hang(child);
    if (end.code == 0) break;
    ASSERT_EQ(end.code, 130) << end.err;
    const char* told = stops == 0 ? "continue with: pulvis resume given-up" : "interrupted";
    EXPECT_THAT(end.err, HasSubstr(told));
    child = start({"resume", "given-up", "--threads", "1"});
    std::this_thread::sleep_for(700ms);
  }
  EXPECT_GE(stops, 1);
  const int code = stops == 2 ? end_or_hang(child).code : 0;
  EXPECT_EQ(code, 0);
  EXPECT_EQ(hash("given-up"), hash("whole"));
}

// ---- inputs -----------------------------------------------------------------------------------------
TEST_F(Limits, NoReaderWaitsForAPipeOrReadsADevice) {
  const std::string pipe = fifo("pipe");
  fs::create_directories(place / "run");
  fs::create_symlink("../pipe", place / "run" / "history.csv");
  fs::create_symlink("../pipe", place / "run" / "run.h5");
  std::ofstream(place / "run" / "scene.toml") << "";
  const std::string lab = paths::source_dir() + "/scenes/lab/";
  for (const std::string& unfit : {pipe, std::string("/dev/zero"), place.string()}) {
    const std::vector<Words> commands{
        {"check", unfit},
        {"study", unfit, "--list"},
        {"check", scene("afm/raster.toml"), "--set", "surface.file=" + unfit},
        {"check", scene("afm/meshed-v.toml"), "--set", "lever.file=" + unfit},
        {"reduce", unfit, unfit, "-o", "reduced"},
        {"reduce", lab + "synthetic-press-1.csv", lab + "synthetic-logger-1.csv", unfit + ".toml"}};
    for (const Words& words : commands) {
      const Outcome end = patient(words, "ulimit -v 4000000");
      EXPECT_EQ(end.code, 2) << words[0] << " " << unfit << ": " << end.err;
    }
  }
  EXPECT_EQ(patient({"report", "run"}).code, 4);
  EXPECT_EQ(patient({"figure", "run"}).code, 2);
}

TEST_F(Limits, MapsInHdf5HaveTheBoundOfThoseInText) {
  {
    hdf5::File file = hdf5::File::create(place / "map.h5");
    file.write("/height", std::vector<double>(2001UL * 2000UL, 1e-9), hdf5::Shape{2001, 2000});
    file.close();
  }
  const Outcome end =
      pulvis({"check", scene("afm/raster.toml"), "--set",
              "surface.file=" + (place / "map.h5").string(), "--set", "surface.dataset=height"});
  EXPECT_EQ(end.code, 2);
  EXPECT_THAT(end.err, HasSubstr("more than 4000000 heights"));
}

// ---- memory -----------------------------------------------------------------------------------------
// 1.05 million elements: 130 s and 5 GB went into the mesh before.
TEST_F(Limits, ALeverThatIsTooLargeIsRefusedBeforeItIsMeshed) {
  const std::string little = "ulimit -v 1000000";
  Outcome end =
      patient({"check", scene("afm/hertz-ball.toml"), "--set", "tip.elements=64"}, little);
  EXPECT_EQ(end.code, 2);
  EXPECT_THAT(end.err, HasSubstr("tip.elements: 64: about 1.06e+06 elements"));
  EXPECT_THAT(end.err, HasSubstr("allowed: at most "));
  end = patient({"check", scene("afm/tipless-beam.toml"), "--set", "lever.elements_along=5000",
                 "--set", "lever.elements_across=5000"},
                little);
  EXPECT_EQ(end.code, 2);
  EXPECT_THAT(end.err, HasSubstr("lever.elements_along: about 2.5e+07 elements"));
}

TEST_F(Limits, ALeverThatThisMachineCannotHoldIsRefusedWithTheFigures) {
  const Words size{"--set", "lever.elements_along=200", "--set", "lever.elements_across=100"};
  for (const char* command : {"run", "check"}) {
    Words words{command, scene("afm/tipless-beam.toml")};
    words.insert(words.end(), size.begin(), size.end());
    const Outcome end = patient(words, "ulimit -v 500000");
    EXPECT_EQ(end.code, 4) << end.err;
    EXPECT_THAT(end.err, HasSubstr("it needs about"));
  }
}

// The report included: what it draws of a million cells is bounded.
TEST_F(Limits, AMillionDensityCellsKeepToTheEstimate) {
  const std::string cells = "output.density_cells=[1000, 1000]";
  const pid_t child = start(short_run("fine", {"--set", cells, "--threads", "1"}));
  rusage used{};
  int status = 0;
  ASSERT_EQ(wait4(child, &status, 0, &used), child);
  EXPECT_EQ(status, 0);
  const Scene fine = read_scene(scene("compaction/regular-25.toml"), {cells});
  EXPECT_LT(1024.0 * static_cast<double>(used.ru_maxrss),
            static_cast<double>(memory_need(fine).total()));
}

// ---- words ------------------------------------------------------------------------------------------
TEST_F(Limits, AQuantityEndsWhereItsTextEnds) {
  EXPECT_THROW(parse_quantity(std::string_view("2.8 ms\0 s", 9), "s"), UnitError);
  EXPECT_THROW(parse_quantity(std::string_view("2.8 ms\0", 7), "s"), UnitError);
  EXPECT_DOUBLE_EQ(parse_quantity("2.8 ms", "s"), 2.8e-3);
}

TEST_F(Limits, NoExpressionTakesLongToJudgeTheEnd) {
  Scene scene;
  ExpectSpec stop;
  stop.stops = true;
  stop.message = "^(x+x+)+y";
  scene.expects.push_back(stop);
  EXPECT_FALSE(ended_as_expected(scene, std::string(100'000, 'x')));
  EXPECT_TRUE(ended_as_expected(scene, std::string(100'000, 'x') + "y"));
}

TEST_F(Limits, ExpressionsThatNeedBacktrackingAreRefused) {
  for (const std::string wrong : {"(?=a)b", "(a)\\\\1", "(((a{1000}){1000}){1000})", "("}) {
    std::ofstream(place / "wrong.toml")
        << text_of(scene("compaction/regular-25.toml"))
        << "\n[[expect]]\noutcome = \"stops\"\nmessage = \"" + wrong + "\"\n";
    const Outcome end = patient({"check", "wrong.toml"});
    EXPECT_EQ(end.code, 2) << wrong;
    EXPECT_THAT(end.err, HasSubstr("expect[0].message: not a regular expression")) << end.err;
  }
}

TEST_F(Limits, TimesThatAreNoNumbersAreRefused) {
  for (const std::string wrong : {"nan", "inf", "-nan", "1e999", "0", "-1"})
    EXPECT_EQ(pulvis(short_run("run", {"--checkpoint-every", wrong})).code, 2) << wrong;
  EXPECT_FALSE(fs::exists(place / "run"));
}

TEST_F(Limits, PackHasNothingToDoWithLevers) {
  const Outcome end = pulvis({"pack", scene("afm/calibration-beam.toml"), "-o", "packing.csv"});
  EXPECT_EQ(end.code, 2);
  EXPECT_THAT(end.err, HasSubstr("an AFM scene has no particles"));
  EXPECT_FALSE(fs::exists(place / "packing.csv"));
}

TEST_F(Limits, FoldersMayBeginWithADashAndTakeDetours) {
  ASSERT_EQ(pulvis(short_run("sub/../-run")).code, 0);
  EXPECT_TRUE(fs::exists(place / "-run" / "summary.json"));
  EXPECT_FALSE(fs::exists(place / "sub"));
  const Outcome end =
      pulvis({"figure", "--series", "energy/elastic", "-o", "sub/../one.csv", "--", "-run"});
  EXPECT_EQ(end.code, 0) << end.err;
  EXPECT_TRUE(fs::exists(place / "one.csv"));
}

TEST_F(Limits, NothingThatIsToldIsAnOrderToTheTerminal) {
  const std::string evil = "\x1b]0;title\x07\x1b[2J";
  const std::string good = scene("compaction/regular-25.toml");
  std::ofstream(place / "title.toml") << "title = 1\n\"\\u001b[31mkey\" = 1\n";
  for (const Words& words : std::vector<Words>{{"check", evil},
                                               {evil},
                                               {"check", good, "--" + evil},
                                               {"check", good, "--set", evil + "=1"},
                                               {"check", good, "--set", "title=" + evil},
                                               {"check", "title.toml"},
                                               {"report", evil},
                                               {"resume", evil},
                                               {"figure", evil},
                                               {"reduce", evil},
                                               {"study", evil}}) {
    const Outcome end = pulvis(words);
    EXPECT_NE(end.code, 0);
    EXPECT_EQ((end.out + end.err).find('\x1b'), std::string::npos) << end.out << end.err;
    EXPECT_EQ((end.out + end.err).find('\x07'), std::string::npos);
  }
}

// ---- cells of tables ----------------------------------------------------------------------------------
TEST_F(Limits, CellsAreQuotedAndFormulasTamed) {
  EXPECT_EQ(csv_cell("plain"), "plain");
  EXPECT_EQ(csv_cell("a,b"), "\"a,b\"");
  EXPECT_EQ(csv_cell("a\"b\nc"), "\"a\"\"b\nc\"");
  EXPECT_EQ(csv_word("=cmd|' /C calc'!A0"), "'=cmd|' /C calc'!A0");
  EXPECT_EQ(csv_word("@SUM(1,2)"), "\"'@SUM(1,2)\"");
  EXPECT_EQ(csv_word("-2+3+cmd"), "'-2+3+cmd");
  EXPECT_EQ(csv_word("+run"), "'+run");
  for (const char* number : {"-0.4 mm", "+1e-3", "-1e-3 kg m^-2", "12", "[0, 1]"})
    EXPECT_EQ(csv_word(number).find('\''), std::string::npos) << number;
}

// The curve of a simulation is named after its folder, whatever that is called.
TEST_F(Limits, NamesOfFoldersStayInTheirCell) {
  const std::string lab = paths::source_dir() + "/scenes/lab/";
  const std::string folder = "a,b\n\"c\"";
  fs::create_directories(place / folder);
  std::ofstream history(place / folder / "history.csv");
  history
      << "time [s],tool/target/position_x [m],tool/target/force_x [N],tool/target/force_y [N]\n";
  for (int i = 0; i < 20; ++i) history << i << ',' << 1e-4 * i << ",10,100\n";
  history.close();
  const Outcome end =
      pulvis({"reduce", lab + "synthetic-press-1.csv", lab + "synthetic-logger-1.csv", "--set",
              "compact.length=10 mm", "--set", "compact.powder=316L", "--set",
              "simulation.target=target", "--simulation", folder, "-o", "reduced"});
  ASSERT_EQ(end.code, 0) << end.err;
  const std::string curves = text_of(place / "reduced" / "curves.csv");
  EXPECT_THAT(curves, HasSubstr(",\"simulation/a,b\n\"\"c\"\" [-]\"\n0,"));
}

// ---- files that vanish, disks that are full -----------------------------------------------------------
TEST_F(Limits, AHistoryThatIsDeletedMeanwhileIsToldOf) {
  const pid_t child = start(short_run("run", {"--set", "stage.press.duration=300 us"}));
  wait_for(place / "run" / "history.csv", child);
  fs::remove(place / "run" / "history.csv");
  const Outcome end = end_or_hang(child);
  EXPECT_EQ(end.code, 4) << end.err;
  EXPECT_THAT(end.err, HasSubstr("history.csv: cannot continue the file: it is no longer there"));
}

TEST_F(Limits, WhatCannotBeToldIsAnError) {
  for (const Words& words : {short_run("run", {"--json"}), Words{"check", "--reference", "text"},
                             Words{"check", scene("compaction/regular-25.toml")}}) {
    const Outcome end = pulvis(words, "exec >/dev/full");
    EXPECT_EQ(end.code, 4) << words[0];
    EXPECT_THAT(end.err, HasSubstr("No space left on device"));
  }
}

TEST_F(Limits, AFullDiskBeforeTheFirstCheckpointDoesNotAdviseToResume) {
  const Outcome end = pulvis(short_run("run"), "ulimit -f 400");  // of 512 bytes: 200 kB
  ASSERT_EQ(end.code, 4) << end.err;
  EXPECT_THAT(end.err, Not(HasSubstr("pulvis resume")));
  EXPECT_THAT(end.err, HasSubstr("there is no checkpoint to continue from"));
}

}  // namespace
}  // namespace pulvis
