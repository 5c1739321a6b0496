// What pulvis run --ranks does with the ranks that it has mpirun start: their exit codes, the signals that it gets, and one
// that is killed. Shell scripts stand in for the program.
#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <sstream>
#include <thread>

#include "cli/ranks/launch_ranks.hpp"
#include "engine/files/output_error.hpp"

namespace pulvis {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class Launch : public ::testing::Test {
 protected:
  void SetUp() override {
    place = fs::temp_directory_path() /
            ("pulvis-launch-" + std::to_string(getpid()) + "-" +
             ::testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(place);
    fs::create_directories(place);
  }
  void TearDown() override { fs::remove_all(place); }

  // Starts three ranks of a script in a process of its own.
  pid_t start(const std::string& script) const {
    const fs::path program = place / "program";
    std::ofstream(program) << "#!/bin/sh\nrank=$OMPI_COMM_WORLD_RANK\ncd " << place << "\n"
                           << script << "\n";
    fs::permissions(program, fs::perms::owner_all);
    const pid_t child = fork();
    if (child != 0) return child;
    if (std::freopen((place / "err").c_str(), "w", stderr) == nullptr) _exit(99);
    int code = thrown;
    try {
      code = static_cast<int>(
          launch_ranks({program, {"run", "a scene", "--quiet"}, 3, place / "results"}));
    } catch (const std::exception& error) {
      std::fprintf(stderr, "%s\n", error.what());
    }
    std::fflush(nullptr);
    _exit(code);
  }
  static constexpr int thrown = 98;

  int end_of(pid_t child) {
    int status = 0;
    waitpid(child, &status, 0);
    std::ostringstream text;
    text << std::ifstream(place / "err").rdbuf();
    err = text.str();
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }
  int code_of(const std::string& script) { return end_of(start(script)); }

  bool has(const std::string& name) const { return fs::exists(place / name); }
  void wait_for(const std::string& name) const {
    for (int i = 0; i < 1000 && !has(name); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    ASSERT_TRUE(has(name));
  }

  fs::path place;
  std::string err;
};

TEST_F(Launch, EveryRankGetsTheWords) {
  EXPECT_EQ(code_of("printf '%s|' \"$@\" > words-$rank"), 0);
  EXPECT_THAT(err, IsEmpty());
  for (const char* file : {"words-0", "words-1", "words-2"}) {
    std::string words;
    std::getline(std::ifstream(place / file), words);
    EXPECT_EQ(words, "run|a scene|--quiet|");
  }
  EXPECT_FALSE(has("words-3"));
}

TEST_F(Launch, ExitCodesAreThoseOfTheRanks) {
  for (const int code : {2, 3, 130}) {
    EXPECT_EQ(code_of("exit " + std::to_string(code)), code);
    EXPECT_THAT(err, IsEmpty()) << "said by the ranks, not once more";
  }
  EXPECT_EQ(code_of("[ $rank = 1 ] && exit 3; sleep 20"), 3) << "one is enough";
}

TEST_F(Launch, TheMachinesFailureIsToldWithHowToGoOn) {
  EXPECT_EQ(code_of("exit 4"), 4);
  EXPECT_THAT(err, HasSubstr("nothing was written"));
  fs::create_directories(place / "results");
  EXPECT_EQ(code_of("echo some >results/run.h5; exit 4"), 4);
  EXPECT_THAT(err, HasSubstr("there is no checkpoint to continue from"));
  EXPECT_EQ(code_of("echo some >results/checkpoint-000000000007.h5; exit 4"), 4);
  EXPECT_THAT(err, HasSubstr("continue with: pulvis resume " + (place / "results").string()));
  EXPECT_EQ(code_of("exit 4"), 4);
  EXPECT_THAT(err, HasSubstr("nothing was written"));
}

TEST_F(Launch, AKilledRankEndsAllAndIsTold) {
  EXPECT_EQ(code_of("[ $rank = 2 ] && kill -9 $$; sleep 20; touch survived"), 4);
  EXPECT_THAT(err, HasSubstr("a rank was killed by signal 9 (Killed)"));
  EXPECT_FALSE(has("survived"));
}

TEST_F(Launch, ACrashedRankIsTold) {
  EXPECT_EQ(code_of("[ $rank = 0 ] && kill -SEGV $$; sleep 20"), 4);
  EXPECT_THAT(err, HasSubstr("a rank was killed by signal 11 (Segmentation fault)"));
}

TEST_F(Launch, OtherExitCodesAreMpiruns) {
  EXPECT_EQ(code_of("exit 1"), 4);
  EXPECT_THAT(err, HasSubstr("mpirun ended with exit code 1"));
}

// Ranks that stop when they are asked to, after some seconds. They wait for each other at their end, as those of MPI do:
// mpirun kills what is left when the first ends with another code than 0. Without their folder they wait for nobody.
std::string stops_after(int seconds) {
  return "stop() { sleep " + std::to_string(seconds) +
         "; touch stopped-$rank\n"
         "while [ -e ready-$rank ] && ! [ -e stopped-0 -a -e stopped-1 -a -e stopped-2 ]; do sleep "
         "0.05; done\n"
         "exit 130; }\n"
         "trap stop USR1; touch ready-$rank; while :; do sleep 0.05; done";
}

// SIGTERM kills what mpirun started within a second; the wish to stop must not.
TEST_F(Launch, SignalsReachTheRanksAndLeaveThemTime) {
  for (const int signal : {SIGINT, SIGTERM, SIGUSR1}) {
    const pid_t child = start(stops_after(2));
    for (const char* rank : {"0", "1", "2"}) wait_for("ready-" + std::string(rank));
    kill(child, signal);
    EXPECT_EQ(end_of(child), 130);
    for (const char* rank : {"0", "1", "2"}) {
      EXPECT_TRUE(has("stopped-" + std::string(rank)));
    }
    for (const char* rank : {"0", "1", "2"}) {
      fs::remove(place / ("stopped-" + std::string(rank)));
      fs::remove(place / ("ready-" + std::string(rank)));
    }
  }
}

TEST_F(Launch, RanksThatCannotHeedASignalYetAreInterrupted) {
  const pid_t child = start("touch ready-$rank; sleep 20; touch survived");
  for (const char* rank : {"0", "1", "2"}) wait_for("ready-" + std::string(rank));
  kill(child, SIGINT);
  EXPECT_EQ(end_of(child), 130);
  EXPECT_THAT(err, HasSubstr("interrupted"));
  EXPECT_FALSE(has("survived"));
}

// Whoever kills the launching process leaves no ranks behind: they stop as at a signal.
TEST_F(Launch, RanksStopWhenTheirLauncherIsKilled) {
  const pid_t child = start(stops_after(0));
  for (const char* rank : {"0", "1", "2"}) wait_for("ready-" + std::string(rank));
  kill(child, SIGKILL);
  EXPECT_EQ(end_of(child), 128 + SIGKILL);
  for (const char* rank : {"0", "1", "2"}) wait_for("stopped-" + std::string(rank));
}

TEST_F(Launch, WithoutMpirunItsPackageIsNamed) {
  const char* before = std::getenv("PATH");
  const std::string path = before != nullptr ? before : "";
  setenv("PATH", place.c_str(), 1);
  const int code = code_of("exit 0");
  setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(code, thrown);
  EXPECT_THAT(err, HasSubstr("openmpi-bin"));
}

TEST(LaunchWords, LessRanks) {
  using Words = std::vector<std::string>;
  EXPECT_EQ(without_ranks({"run", "--ranks", "4", "s.toml"}), (Words{"run", "s.toml"}));
  EXPECT_EQ(without_ranks({"run", "s.toml", "--ranks=4", "--quiet"}),
            (Words{"run", "s.toml", "--quiet"}));
}

TEST(LaunchRoom, IsAskedForBeforeTheRanksStart) {
  const fs::path here = fs::temp_directory_path();
  EXPECT_NO_THROW(require_room_to_start(here, 1));
  EXPECT_THROW(require_room_to_start(here, std::uintmax_t{1} << 62), OutputError);
  EXPECT_THROW(require_room_to_start(here / "missing", 1), OutputError);
}

}  // namespace
}  // namespace pulvis
