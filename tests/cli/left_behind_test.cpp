// What killed programs leave behind stands in nobody's way: checkpoints of another run, halves of files, a run
// without its report.
#include <gmock/gmock.h>

#include "engine/files/checkpoint.hpp"
#include "tests/helpers/paths.hpp"
#include "tests/helpers/program.hpp"

namespace pulvis {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class LeftBehind : public ProgramTest {
 protected:
  Outcome run(const Words& more = {}) const {
    return pulvis(with(short_run("run", {"--threads", "1"}), more));
  }
  void keep_only_checkpoints() const {
    for (const auto& entry : fs::directory_iterator(place / "run"))
      if (!entry.path().filename().string().starts_with("checkpoint-")) fs::remove(entry.path());
  }
  std::string state_hash() const {
    const std::string text = text_of(place / "run/summary.json");
    return text.substr(text.find("state_hash"), 32);
  }
};

TEST_F(LeftBehind, CheckpointsOfARunThatIsGoneDoNotStopTheNext) {
  ASSERT_EQ(run().code, 0);
  const std::string whole = state_hash();
  ASSERT_EQ(run({"--overwrite", "--stop-after", "150", "--set", "contact.friction=0.3"}).code, 130);
  keep_only_checkpoints();
  const Outcome stopped = run({"--stop-after", "50"});
  EXPECT_EQ(stopped.code, 130) << stopped.err;
  const Outcome rest = pulvis({"resume", "run"});
  EXPECT_EQ(rest.code, 0) << rest.err;
  EXPECT_EQ(state_hash(), whole);
}

// As if the next run had been killed before its first checkpoint, or somebody had put the files together.
TEST_F(LeftBehind, ResumeTakesNoCheckpointOfAnotherRun) {
  ASSERT_EQ(run({"--stop-after", "150"}).code, 130);
  fs::rename(place / "run", place / "other");
  ASSERT_EQ(run({"--stop-after", "50"}).code, 130);
  for (const fs::path& file : checkpoints_in(place / "other"))
    fs::copy_file(file, place / "run" / file.filename(), fs::copy_options::overwrite_existing);
  const Outcome rest = pulvis({"resume", "run"});
  EXPECT_EQ(rest.code, 0) << rest.err;
  EXPECT_THAT(rest.out, HasSubstr("resumed at step 50,"));

  ASSERT_EQ(run({"--overwrite", "--stop-after", "50"}).code, 130);
  for (const fs::path& file : checkpoints_in(place / "run")) fs::remove(file);
  for (const fs::path& file : checkpoints_in(place / "other"))
    fs::copy_file(file, place / "run" / file.filename());
  const Outcome none = pulvis({"resume", "run"});
  EXPECT_EQ(none.code, 2);
  EXPECT_THAT(none.err, HasSubstr("only those of other runs"));
}

TEST_F(LeftBehind, HalvesOfFilesGoWithTheNextRunAndResume) {
  for (const Words& next : {Words{"resume", "run"}, Words{}}) {
    ASSERT_EQ(run({"--overwrite", "--stop-after", "50"}).code, 130);
    std::ofstream(place / "run/checkpoint-000000000060.h5.new")
        << "pulvis checkpoint, not finished\n";
    std::ofstream(place / "run/checkpoint-000000000070.h5.new");
    EXPECT_EQ((next.empty() ? run({"--overwrite"}) : pulvis(next)).code, 0);
    EXPECT_FALSE(fs::exists(place / "run/checkpoint-000000000060.h5.new"));
    EXPECT_FALSE(fs::exists(place / "run/checkpoint-000000000070.h5.new"));
  }
}

class StudyLeftBehind : public LeftBehind {
 protected:
  void write(const std::string& rest) const {
    std::ofstream(place / "study.toml")
        << "scene = \"" << scene("compaction/regular-25.toml") << "\"\n[set]\n"
        << "\"stage.press.duration\" = \"20 us\"\n"
        << "\"stage.press.move[0].displacement\" = [\"0 mm\", \"-0.4 mm\"]\n"
        << "output.frames = 2\noutput.samples = 40\n"
        << rest;
  }
  Outcome study() const { return pulvis({"study", "study.toml", "-o", "s"}); }
};

// A run takes its old report away before it writes its summary: this is what a kill between the two leaves.
TEST_F(StudyLeftBehind, ARunKilledBetweenSummaryAndReportGetsItsReport) {
  write("[grid]\ncontact.friction = [0.1]\n");
  ASSERT_EQ(study().code, 0);
  fs::remove(place / "s/friction=0.1/report.html");
  const Outcome again = study();
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_THAT(again.out, HasSubstr("1 finished before"));
  EXPECT_TRUE(fs::exists(place / "s/friction=0.1/report.html"));
}

TEST_F(StudyLeftBehind, NamesOfTheStudysOwnFilesAreRefusedAtTheStart) {
  for (const char* name :
       {"report.html", "study.csv", "fits.csv", "strengths.csv", "summary.json", "curves.json",
        "study.toml", "pictures", "inputs", "Report.HTML", "..", ".", ".pulvis-files"}) {
    write(std::string("[[variation]]\nname = \"") + name + "\"\n");
    const Outcome end = study();
    EXPECT_EQ(end.code, 2) << name << end.out;
    EXPECT_THAT(end.err, HasSubstr("name: ")) << name;
    EXPECT_THAT(end.err, HasSubstr(name));
    EXPECT_FALSE(fs::exists(place / "s"));
  }
}

}  // namespace
}  // namespace pulvis
