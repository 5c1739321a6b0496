// pulvis study --slurm as far as it needs no cluster: what is refused, what would be submitted, and whose runs are left to
// others. Programs called sbatch and squeue stand in for Slurm's; with the real ones it is tests/slurm_study.py.
#include <gmock/gmock.h>

#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <thread>

#include "cli/shell_word.hpp"
#include "cli/slurm/slurm_script.hpp"
#include "engine/files/run_folder.hpp"
#include "tests/helpers/program.hpp"

namespace pulvis {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

class SlurmCommand : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    results = place / "results";
    fs::create_directories(place / "bin");
    std::ofstream(place / "study.toml")
        << "scene = \"" << scene("compaction/regular-25.toml") << "\"\n[set]\n"
        << "\"stage.press.duration\" = \"10 us\"\noutput.frames = 1\noutput.samples = 10\n"
        << "\"stage.press.move[0].displacement\" = [\"0 mm\", \"-0.2 mm\"]\n"
        << "[grid]\ncontact.friction = [0.1, 0.2, 0.3]\n";
  }

  // A program that is found before any other of its name.
  void stand_in(const char* name, const std::string& text) const {
    const fs::path file = place / "bin" / name;
    std::ofstream(file) << "#!/bin/sh\n" << text << "\n";
    fs::permissions(file, fs::perms::owner_all);
  }

  Outcome study(const Words& more = {}) const {
    return pulvis(with({"study", (place / "study.toml").string(), "-o", results.string()}, more),
                  "PATH=" + (place / "bin").string() + ":$PATH");
  }
  Outcome submit(const Words& more = {}) const { return study(with({"--slurm"}, more)); }

  void submit_in_two_tasks() const {
    stand_in("sbatch", "echo 77");
    ASSERT_EQ(submit({"--array-size", "2"}).code, 0);
  }

  bool has(const char* run) const { return fs::exists(results / run / "summary.json"); }

  fs::path results;
};

TEST_F(SlurmCommand, DryRunPrintsTheJobAndChangesNothing) {
  const Outcome end = submit({"--dry-run", "--partition", "long", "--time", "1:00:00", "--jobs",
                              "5", "--threads-per-run", "3", "--array-size", "2",
                              "--sbatch=--account=powders", "--sbatch=--comment=all of it"});
  EXPECT_EQ(end.code, 0) << end.err;
  for (const char* line :
       {"#SBATCH --array=0-1%5\n", "#SBATCH --cpus-per-task=3\n", "#SBATCH --partition=long\n",
        "#SBATCH --time=1:00:00\n", "#SBATCH --requeue\n", "#SBATCH --signal=B:USR1@120\n",
        "#SBATCH --account=powders\n", "#SBATCH '--comment=all of it'\n",
        "runs=(\n  friction=0.1\n  friction=0.2\n  friction=0.3\n)\n",
        "study slurm/1/study.toml -o . \"${mine[@]}\" --jobs 1"})
    EXPECT_THAT(end.out, HasSubstr(line));
  EXPECT_THAT(end.out, HasSubstr("cd " + results.string() + " && sbatch --parsable slurm.sh\n"));
  EXPECT_FALSE(fs::exists(results));
}

// Tasks of the first submission may still wait when the study has changed and is submitted again.
TEST_F(SlurmCommand, EverySubmissionHasItsOwnCopyOfTheStudy) {
  submit_in_two_tasks();
  const std::string first = text_of(results / "slurm/1/study.toml");
  stand_in("squeue", "echo 77 0; echo 77 1");
  std::ofstream(place / "study.toml", std::ios::app) << "element.formulation = [\"four-point\"]\n";
  ASSERT_EQ(submit().code, 0);
  EXPECT_EQ(text_of(results / "slurm/1/study.toml"), first);
  EXPECT_THAT(text_of(results / "slurm/2/study.toml"), HasSubstr("four-point"));
  EXPECT_THAT(text_of(results / "slurm.sh"), HasSubstr("study slurm/2/study.toml"));
  EXPECT_EQ(study({"--gather"}).code, 130);
  EXPECT_EQ(text_of(results / "slurm/1/study.toml"), first);
}

TEST_F(SlurmCommand, AFolderThatSlurmWouldNotFindIsRefused) {
  for (const char* name : {"Fe-2%Al", "res\\ult"}) {
    const Outcome end = pulvis({"study", (place / "study.toml").string(), "-o",
                                (place / name).string(), "--slurm", "--dry-run"});
    EXPECT_EQ(end.code, 4) << end.out;
    EXPECT_THAT(end.err, HasSubstr("Slurm replaces"));
  }
}

// What they say would come before the script, or hide its tasks.
TEST_F(SlurmCommand, VariablesOfSlurmForTheSameOptionsAreNotPassedOn) {
  stand_in("sbatch",
           "env | grep ^SBATCH_ | sort | tr '\\n' ' ' >" + (place / "seen").string() + "; echo 77");
  stand_in("squeue", "test -z \"$SQUEUE_STATES\" && echo 77 0");
  setenv("SBATCH_ARRAY_INX", "0-1", 1);
  setenv("SBATCH_TIMELIMIT", "7", 1);
  setenv("SBATCH_ACCOUNT", "powders", 1);
  setenv("SQUEUE_STATES", "RUNNING", 1);
  EXPECT_EQ(submit({"--array-size", "1"}).code, 0);
  EXPECT_EQ(text_of(place / "seen"), "SBATCH_ACCOUNT=powders SBATCH_TIMELIMIT=7 ");
  EXPECT_THAT(submit({"--dry-run"}).out, HasSubstr("3 under way"));
  fs::remove_all(results);
  EXPECT_EQ(submit({"--time", "5"}).code, 0);
  EXPECT_EQ(text_of(place / "seen"), "SBATCH_ACCOUNT=powders ");
  for (const char* name :
       {"SBATCH_ARRAY_INX", "SBATCH_TIMELIMIT", "SBATCH_ACCOUNT", "SQUEUE_STATES"})
    unsetenv(name);
}

// A quarter of a short limit is left for the checkpoint, of a long one two minutes.
TEST_F(SlurmCommand, RunsAreWarnedInTime) {
  EXPECT_THAT(submit({"--dry-run", "--time", "1"}).out, HasSubstr("USR1@15\n"));
  EXPECT_THAT(submit({"--dry-run", "--time", "4:00"}).out, HasSubstr("USR1@60\n"));
  EXPECT_THAT(submit({"--dry-run", "--time", "2-0"}).out, HasSubstr("USR1@120\n"));
  EXPECT_THAT(submit({"--dry-run"}).out, HasSubstr("USR1@120\n"));
}

TEST(SlurmTimeLimit, IsReadAsSbatchReadsIt) {
  EXPECT_EQ(time_limit_seconds("30"), 1800);
  EXPECT_EQ(time_limit_seconds("30:10"), 1810);
  EXPECT_EQ(time_limit_seconds("1:30:10"), 5410);
  EXPECT_EQ(time_limit_seconds("2-12"), 216000);
  EXPECT_EQ(time_limit_seconds("2-12:30"), 217800);
  EXPECT_EQ(time_limit_seconds("2-12:30:10"), 217810);
  for (const char* wrong : {"", "0", "0:0:0", "-1", "1h", "1:", ":1", "1:2:3:4", "1-", "-", "1.5",
                            "2-1:2:3:4", " 1", "1 ", "99999999999", "UNLIMITED"})
    EXPECT_EQ(time_limit_seconds(wrong), std::nullopt) << wrong;
}

TEST_F(SlurmCommand, WrongOptionsAreRefused) {
  for (const Words& options : {Words{"--dry-run"},
                               {"--partition", "long"},
                               {"--time", "30"},
                               {"--array-size", "3"},
                               {"--sbatch=--mem=4G"}}) {
    const Outcome end = study(options);
    EXPECT_EQ(end.code, 2) << options[0];
    EXPECT_THAT(end.err, HasSubstr(" requires --slurm"));
  }
  for (const char* option : {"--fresh", "--list", "--gather"}) {
    const Outcome end = submit({option});
    EXPECT_EQ(end.code, 2) << option;
    EXPECT_THAT(end.err, HasSubstr("excludes"));
  }
  const Outcome time = submit({"--time", "half an hour"});
  EXPECT_EQ(time.code, 2);
  EXPECT_THAT(time.err, HasSubstr("'half an hour' is not a time limit, allowed: minutes, "));
  EXPECT_EQ(submit({"--array-size", "0"}).code, 2);
  EXPECT_EQ(submit({"--partition", "two\nlines"}).code, 2);
  for (const char* own :
       {"--array=0-9", "--arr=1", "--chdir=/tmp", "-c", "-c4", "-a0-3", "-D/tmp", "-Hc4"}) {
    const Outcome set = submit({"--sbatch=" + std::string(own), "--dry-run"});
    EXPECT_EQ(set.code, 2) << own;
    EXPECT_THAT(set.err, HasSubstr("is set by the study itself"));
  }
  for (const char* wrong : {"account", "--", "-"})
    EXPECT_EQ(submit({"--sbatch=" + std::string(wrong)}).code, 2) << wrong;
  for (const char* other : {"-Apowders", "-C", "-H", "--constraint=fast", "-d1"})
    EXPECT_EQ(submit({"--sbatch=" + std::string(other), "--dry-run"}).code, 0) << other;
  const Outcome run = study({"--run", "friction=0.4"});
  EXPECT_EQ(run.code, 2);
  EXPECT_THAT(run.err, HasSubstr("there is no run 'friction=0.4' in this study"));
  EXPECT_FALSE(fs::exists(results));
}

TEST_F(SlurmCommand, AMachineWithoutSlurmSaysSo) {
  const Outcome end =
      pulvis({"study", (place / "study.toml").string(), "-o", results.string(), "--slurm"},
             "PATH=" + (place / "bin").string());
  EXPECT_EQ(end.code, 4);
  EXPECT_THAT(end.err,
              HasSubstr("sbatch: cannot submit the study: there is no such program on PATH"));
  EXPECT_FALSE(fs::exists(results));
}

TEST_F(SlurmCommand, WhatSbatchSaysIsTold) {
  stand_in("sbatch",
           "[ $1 = --version ] && exit 0\necho 'sbatch: error: no budget left' >&2\nexit 1");
  const Outcome refused = submit();
  EXPECT_EQ(refused.code, 4);
  EXPECT_THAT(refused.err,
              HasSubstr("sbatch ended with exit code 1: sbatch: error: no budget left"));
  EXPECT_FALSE(fs::exists(results / "slurm.json"));

  // Sites have their own remarks; the job's number stands alone.
  stand_in("sbatch", "echo 'sbatch: account: powders' >&2\necho '77;west'");
  const Outcome end = submit({"--array-size", "2"});
  EXPECT_EQ(end.code, 0) << end.err;
  EXPECT_THAT(end.out, HasSubstr("submitted as Slurm job 77: 2 tasks of 1 thread"));
  const auto arrays = nlohmann::json::parse(text_of(results / "slurm.json"))["arrays"];
  ASSERT_EQ(arrays.size(), 1U);
  EXPECT_EQ(arrays[0]["job"], "77");
  EXPECT_EQ(arrays[0]["cluster"], "west");
  EXPECT_EQ(arrays[0]["tasks"], 2);
  EXPECT_EQ(arrays[0]["runs"].size(), 3U);
}

// Task 0 of two has the first and the third run.
TEST_F(SlurmCommand, RunsInTheQueueAreNotStartedTwice) {
  submit_in_two_tasks();
  stand_in("squeue", "echo '77 0'");
  const Outcome some = study();
  EXPECT_EQ(some.code, 130) << some.err;
  EXPECT_THAT(some.out, HasSubstr("1 of 3 runs good, 2 not finished yet"));
  EXPECT_THAT(some.out,
              HasSubstr("not started here: friction=0.3: under way: task 0 of Slurm job 77\n"));
  EXPECT_FALSE(has("friction=0.1"));
  EXPECT_TRUE(has("friction=0.2"));
  EXPECT_FALSE(has("friction=0.3"));
  EXPECT_THAT(text_of(results / "summary.json"), HasSubstr("under way: task 0 of Slurm job 77"));
  EXPECT_THAT(submit().out, HasSubstr("there is nothing to submit"));

  stand_in("squeue", "echo 'slurm_load_jobs error: Invalid job id specified' >&2; exit 1");
  const Outcome rest = study();
  EXPECT_EQ(rest.code, 0) << rest.err;
  EXPECT_THAT(rest.out, HasSubstr("3 runs: 2 to do, 1 finished before"));
  EXPECT_FALSE(fs::exists(results / "slurm.json"));
}

TEST_F(SlurmCommand, WhereSlurmCannotBeAskedItsRunsAreLeftAlone) {
  submit_in_two_tasks();
  stand_in("squeue", "echo 'squeue: error: Unable to contact slurm controller' >&2; exit 1");
  const Outcome end = study();
  EXPECT_EQ(end.code, 130);
  EXPECT_THAT(end.err, HasSubstr("cannot query Slurm about job 77 (squeue: error: Unable"));
  EXPECT_THAT(end.out, HasSubstr("3 runs: 0 to do, 0 finished before"));
  fs::remove(results / "slurm.json");
  EXPECT_EQ(study().code, 0);
}

TEST_F(SlurmCommand, ADamagedListIsRefused) {
  submit_in_two_tasks();
  for (const char* text :
       {"{", "{}", R"({"arrays": [{"job": "1", "cluster": "", "tasks": 0, "runs": []}]})"}) {
    fs::remove(results / ".pulvis-files");
    std::ofstream(results / "slurm.json") << text;
    EXPECT_NE(study().code, 0) << text;
    EXPECT_FALSE(has("friction=0.1")) << text;
  }
}

// The same of any process, on a cluster or not; an old result stays where it is.
TEST_F(SlurmCommand, ARunThatAnotherProcessWritesIsLeftToIt) {
  ASSERT_EQ(study({"--run", "friction=0.2"}).code, 0);
  std::string text = text_of(place / "study.toml");  // another study now: its run is to be done
  std::ofstream(place / "study.toml") << text.replace(text.find("10 us"), 5, "12 us");
  const std::string before = text_of(results / "friction=0.2" / "summary.json");
  {
    const FolderLock lock(results / "friction=0.2");
    const Outcome end = study();
    EXPECT_EQ(end.code, 130) << end.err;
    EXPECT_THAT(end.out, HasSubstr("2 of 3 runs good, 1 not finished yet"));
  }
  EXPECT_EQ(text_of(results / "friction=0.2" / "summary.json"), before);
  EXPECT_EQ(study().code, 0);
}

TEST_F(SlurmCommand, OneRunAloneLeavesNoTable) {
  const Outcome end = study({"--run", "friction=0.3", "--run", "friction=0.1"});
  EXPECT_EQ(end.code, 0) << end.err;
  EXPECT_TRUE(has("friction=0.1"));
  EXPECT_FALSE(fs::exists(results / "friction=0.2"));
  EXPECT_TRUE(has("friction=0.3"));
  for (const char* name : {"study.toml", "study.csv", "summary.json", "report.html"})
    EXPECT_FALSE(fs::exists(results / name)) << name;
  const Outcome all = study();
  EXPECT_EQ(all.code, 0) << all.err;
  EXPECT_THAT(all.out, HasSubstr("3 runs: 1 to do, 2 finished before"));
}

TEST_F(SlurmCommand, GatheringStartsNothing) {
  ASSERT_EQ(study({"--run", "friction=0.3"}).code, 0);
  const Outcome end = study({"--gather"});
  EXPECT_EQ(end.code, 130);
  EXPECT_THAT(end.out, HasSubstr("1 of 3 runs good, 2 not finished yet"));
  EXPECT_FALSE(fs::exists(results / "friction=0.1"));
  EXPECT_TRUE(fs::exists(results / "report.html"));
}

// Else a task with too short a time limit would be queued again for ever.
TEST_F(SlurmCommand, StoppedBeforeAnyFirstStepIsNoInterruption) {
  std::ofstream(place / "study.toml") << "scene = \"" << scene("compaction/random-100.toml")
                                      << "\"\n[grid]\ncontact.friction = [0.1]\n";
  const pid_t program = start(
      {"study", (place / "study.toml").string(), "-o", results.string(), "--run", "friction=0.1"});
  for (int tries = 0; tries < 3000 && !fs::exists(results / "friction=0.1" / "log.txt"); ++tries)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  kill(program, SIGTERM);
  const Outcome end = end_of(program);
  EXPECT_EQ(end.code, 4) << end.out;
  EXPECT_THAT(end.err, HasSubstr("interrupted before the first step of a run"));
}

// A line break would end the line of #SBATCH, and the rest of the name would be a command.
TEST_F(SlurmCommand, NamesOfStudiesAreNoCommands) {
  const fs::path study = place / "a\ntouch INJECTED\nb.toml";
  std::ofstream(study) << "scene = \"" << scene("compaction/random-100.toml")
                       << "\"\n[grid]\ncontact.friction = [0.1]\n";
  const Outcome end =
      end_of(start({"study", study.string(), "-o", results.string(), "--slurm", "--dry-run"}));
  ASSERT_EQ(end.code, 0) << end.err;
  EXPECT_THAT(end.out, HasSubstr("--job-name=pulvis-a"));
  EXPECT_THAT(end.out, Not(HasSubstr("\ntouch")));
}

TEST_F(SlurmCommand, WordsOfTheShellMeanTheirText) {
  for (const std::string text :
       {"plain", "", "it's", "$(rm x) `y` \\ \"z\"", "a b\tc", "*?[~]#!"}) {
    std::ofstream(place / "words.sh") << "printf %s " << shell_word(text) << " > words.txt\n";
    const std::string command = "cd '" + place.string() + "' && bash words.sh";
    ASSERT_EQ(std::system(command.c_str()), 0);
    EXPECT_EQ(text_of(place / "words.txt"), text);
  }
}

}  // namespace
}  // namespace pulvis
