// pulvis run --ranks as far as it needs no MPI: what is refused, and what mpirun is told; a script called mpirun stands in
// for it. With Open MPI's it is tests/mpi.
#include <gmock/gmock.h>

#include "cli/ranks/join_ranks.hpp"
#include "tests/helpers/program.hpp"

namespace pulvis {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

class RanksCommand : public ProgramTest {
 protected:
  static bool has_mpi() { return fs::exists(fs::path(paths::libraries()) / "libpulvis_mpi.so"); }
};

TEST_F(RanksCommand, NumbersOutsideTheRangeAreRefused) {
  for (const char* number : {"0", "-1", "1025", "two"}) {
    const Outcome end = pulvis(short_run("r", {"--ranks", number}));
    EXPECT_EQ(end.code, 2) << number;
    EXPECT_THAT(end.err, HasSubstr("--ranks"));
    EXPECT_FALSE(fs::exists(place / "r"));
  }
  EXPECT_THAT(pulvis(short_run("r", {"--ranks", "0"})).err, HasSubstr("1 to 1024"));
}

TEST_F(RanksCommand, OneRankNeedsNoMpirun) {
  const Outcome end = pulvis(short_run("r", {"--ranks", "1"}), "PATH=/nowhere");
  EXPECT_EQ(end.code, 0) << end.err;
  EXPECT_TRUE(fs::exists(place / "r" / "summary.json"));
}

TEST_F(RanksCommand, ARankStartsNoRanks) {
  const Outcome end = pulvis(short_run("r", {"--ranks", "2"}), "export OMPI_COMM_WORLD_SIZE=2");
  EXPECT_EQ(end.code, 2);
  EXPECT_THAT(end.err, HasSubstr("itself"));
}

TEST_F(RanksCommand, AWrongSceneIsRefusedBeforeRanksStart) {
  const Outcome end =
      pulvis({"run", scene("compaction/regular-25.toml"), "--ranks", "2", "--set", "no.key=1"});
  EXPECT_EQ(end.code, 2);
  EXPECT_THAT(end.err, HasSubstr("no"));
}

TEST_F(RanksCommand, WithoutMpiItsPackageIsNamed) {
  if (has_mpi()) GTEST_SKIP() << "this build has MPI";
  const Outcome end = pulvis(short_run("r", {"--ranks", "2"}));
  EXPECT_EQ(end.code, 4);
  EXPECT_THAT(end.err, ::testing::AllOf(HasSubstr("pulvis-mpi"), HasSubstr("-DPULVIS_MPI=ON")));
}

TEST_F(RanksCommand, StudiesAreNoRanks) {
  for (const char* command : {"study", "probe", "fit"}) {
    const Outcome end = pulvis({command, "some.toml"}, "export OMPI_COMM_WORLD_SIZE=2");
    EXPECT_EQ(end.code, 2);
    EXPECT_THAT(end.err, HasSubstr("cannot be one of several ranks"));
  }
}

// An mpirun that starts nothing: the run of before stays what it was, and is not offered as this one.
TEST_F(RanksCommand, AFolderInWhichNothingWasWrittenIsNotContinued) {
  if (!has_mpi()) GTEST_SKIP() << "this build has no MPI";
  ASSERT_EQ(pulvis(short_run("r", {"--stop-after", "5"})).code, 130);
  std::ofstream(place / "mpirun") << "#!/bin/sh\nexit 243\n";
  fs::permissions(place / "mpirun", fs::perms::owner_all);
  const Outcome end =
      pulvis(short_run("r", {"--ranks", "2", "--overwrite"}), "PATH=" + place.string() + ":$PATH");
  EXPECT_EQ(end.code, 4);
  EXPECT_THAT(end.err,
              ::testing::AllOf(HasSubstr("exit code 243"), HasSubstr("nothing was written"),
                               Not(HasSubstr("signal")), Not(HasSubstr("resume"))));
}

TEST_F(RanksCommand, MpirunGetsTheProgramAndItsWords) {
  if (!has_mpi()) GTEST_SKIP() << "this build has no MPI";
  std::ofstream(place / "mpirun") << "#!/bin/sh\nprintf '%s ' \"$@\" >words\nexit 3\n";
  fs::permissions(place / "mpirun", fs::perms::owner_all);
  const Outcome end = pulvis(short_run("r", {"--ranks", "2", "--threads", "3"}),
                             "PATH=" + place.string() + ":$PATH");
  EXPECT_EQ(end.code, 3) << end.err;
  const std::string words = text_of(place / "words");
  EXPECT_THAT(words, HasSubstr("-np 2 "));
  EXPECT_THAT(words, HasSubstr(paths::program() + " run "));
  EXPECT_THAT(words, HasSubstr("-o r "));
  EXPECT_THAT(words, HasSubstr("--threads 3 "));
  EXPECT_THAT(words, Not(HasSubstr("--ranks")));
}

// What a starter leaves in the environment, and whether that makes the process one of several.
TEST(RanksStarted, OnlyMpirunAndStepsOfSeveralTasksStartRanks) {
  using Environment = std::vector<std::pair<const char*, const char*>>;
  const std::vector<std::pair<Environment, bool>> cases{
      {{}, false},
      {{{"OMPI_COMM_WORLD_SIZE", "4"}, {"PMIX_RANK", "0"}}, true},
      {{{"OMPI_COMM_WORLD_SIZE", "1"}, {"PMIX_RANK", "0"}}, false},
      // a script of sbatch with several tasks
      {{{"SLURM_NTASKS", "4"}, {"SLURM_PROCID", "0"}, {"SLURM_JOB_ID", "7"}}, false},
      // mpirun -np 1 in a step of several tasks
      {{{"OMPI_COMM_WORLD_SIZE", "1"}, {"PMIX_RANK", "0"}, {"SLURM_STEP_NUM_TASKS", "4"}}, false},
      {{{"PMIX_RANK", "2"}, {"SLURM_STEP_NUM_TASKS", "4"}}, true},
      {{{"PMI_RANK", "2"}, {"SLURM_STEP_NUM_TASKS", "4"}}, true},
      {{{"PMIX_RANK", "0"}, {"SLURM_STEP_NUM_TASKS", "1"}}, false},
      // srun --mpi=none: tasks that know nothing of each other
      {{{"SLURM_PROCID", "2"}, {"SLURM_STEP_NUM_TASKS", "4"}}, false},
  };
  const auto clear = [] {
    for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK", "SLURM_NTASKS",
                             "SLURM_PROCID", "SLURM_JOB_ID", "SLURM_STEP_NUM_TASKS"})
      unsetenv(name);
  };
  for (std::size_t i = 0; i < cases.size(); ++i) {
    clear();
    for (const auto& [name, value] : cases[i].first) setenv(name, value, 1);
    EXPECT_EQ(started_as_rank(), cases[i].second) << "case " << i;
  }
  clear();
  EXPECT_EQ(join_ranks(), nullptr);
}

}  // namespace
}  // namespace pulvis
