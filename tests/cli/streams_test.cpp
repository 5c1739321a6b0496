// Standard output and error that cannot be written: a run goes on, and ends with its own exit code.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/files/hdf5.hpp"
#include "tests/helpers/program.hpp"

namespace pulvis {
namespace {

using ::testing::HasSubstr;

class Streams : public ProgramTest {
 protected:
  // A pipe whose reader has ended.
  static std::string broken_pipe(int stream) {
    return "mkfifo pipe; head -c 0 <pipe & exec " + std::to_string(stream) + ">pipe; wait; rm pipe";
  }
  static std::vector<std::string> lost(int stream) {
    const std::string number = std::to_string(stream);
    return {"exec " + number + ">&-", "exec " + number + ">/dev/full", broken_pipe(stream)};
  }
  void expect_whole_run() const {
    const auto file = hdf5::File::open(place / "run" / "run.h5");
    EXPECT_EQ(file.text_attribute("/", "outcome"), "done");
    EXPECT_EQ(file.damaged_datasets(), std::vector<std::string>());
    EXPECT_TRUE(std::filesystem::exists(place / "run" / "report.html"));
  }
};

TEST_F(Streams, ALostStandardErrorKeepsTheExitCode) {
  for (const std::string& shell : lost(2)) {
    EXPECT_EQ(pulvis({"check", "missing.toml"}, shell).code, 2) << shell;
    EXPECT_EQ(pulvis({"wrong"}, shell).code, 2) << shell;
    EXPECT_EQ(
        pulvis(short_run("run", {"--overwrite", "--set", "limits.energy_balance=1e-14"}), shell)
            .code,
        3)
        << shell;
    EXPECT_EQ(pulvis(short_run("run", {"--overwrite"}), "ulimit -f 400; " + shell).code, 4)
        << shell;
  }
}

// A quiet run warns on standard error.
TEST_F(Streams, ARunGoesOnWithoutAnyStream) {
  const Words warned = short_run("run", {"--overwrite", "--quiet"});
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(pulvis(warned, lost(1)[i] + "; " + lost(2)[i]).code, 0) << lost(2)[i];
    expect_whole_run();
  }
  EXPECT_EQ(pulvis(warned, "exec <&- >&- 2>&-").code, 0);
  expect_whole_run();
}

TEST_F(Streams, LostOutputIsAFailureOnlyWhereItIsTheResult) {
  const std::string of = scene("compaction/regular-25.toml");
  for (const std::string& shell : lost(1)) {
    EXPECT_EQ(pulvis(short_run("run", {"--overwrite"}), shell).code, 0) << shell;
    expect_whole_run();
    for (const Words& words : {Words{"plan", of}, Words{"check", "--print", of}, Words{"--help"},
                               short_run("run", {"--overwrite", "--json"})}) {
      const Outcome end = pulvis(words, shell);
      EXPECT_EQ(end.code, 4) << words[0] << ", " << shell;
      EXPECT_THAT(end.err, HasSubstr("standard output: cannot write: ")) << words[0];
    }
  }
}

}  // namespace
}  // namespace pulvis
