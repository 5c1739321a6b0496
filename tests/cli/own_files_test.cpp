// What the commands do to files that are not theirs: nothing, with or without --overwrite. They are refused
// before anything is computed, by name.
#include <gmock/gmock.h>

#include "tests/helpers/paths.hpp"
#include "tests/helpers/program.hpp"

namespace pulvis {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class OwnFilesOfCommands : public ProgramTest {
 protected:
  Outcome run(const std::string& folder, const Words& more = {}) const {
    return pulvis(with(short_run(folder, {"--threads", "1"}), more));
  }
  void put(const std::string& name, const std::string& text = "mine\n") const {
    fs::create_directories((place / name).parent_path());
    std::ofstream(place / name) << text;
  }
  void expect_refused(const Words& words, const std::string& name) const {
    const std::string before = text_of(place / name);
    const Outcome end = pulvis(words);
    EXPECT_EQ(end.code, 2) << name << ": " << end.out << end.err;
    EXPECT_THAT(end.err, HasSubstr(fs::path(name).filename().string()));
    EXPECT_EQ(text_of(place / name), before) << name;
  }
};

TEST_F(OwnFilesOfCommands, ARunLeavesTheSceneThatIsGiven) {
  fs::create_directory(place / "own");
  fs::copy_file(scene("compaction/regular-25.toml"), place / "own/scene.toml");
  fs::create_directory_symlink(place / "own", place / "way");
  for (const Words& more : {Words{}, Words{"--overwrite"}})
    for (const char* given : {"own/scene.toml", "way/scene.toml", "way/../own/scene.toml"})
      expect_refused(with(with({"run", given, "-o", "own"}, quick()), more), "own/scene.toml");
  EXPECT_FALSE(fs::exists(place / "own/run.h5"));
}

TEST_F(OwnFilesOfCommands, ARunLeavesEveryFileThatIsNotItsOwn) {
  for (const char* name : {"scene.toml", "run.h5", "run.h5.new", "run.h5.journal", "run.xdmf",
                           "run.vtkhdf", "tools.vtkhdf", "history.csv", "summary.json",
                           "report.html", "checkpoint-000000000000.h5"}) {
    const std::string folder = std::string("with-") + name;
    put(folder + "/" + name);
    for (const Words& more : {Words{}, Words{"--overwrite"}})
      expect_refused(short_run(folder, more), folder + "/" + name);
  }
}

TEST_F(OwnFilesOfCommands, ARunIsReplacedIfAskedAndWhatIsNotOfItStays) {
  ASSERT_EQ(run("run").code, 0);
  ASSERT_EQ(pulvis({"figure", "run", "--format", "csv"}).code, 0);
  put("run/pictures/mine.png");
  put("run/notes.txt");
  EXPECT_EQ(run("run").code, 2);
  const Outcome again = run("run", {"--overwrite"});
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(text_of(place / "run/pictures/mine.png"), "mine\n");
  EXPECT_EQ(text_of(place / "run/notes.txt"), "mine\n");
  EXPECT_FALSE(fs::exists(place / "run/pictures/force.csv"));
}

TEST_F(OwnFilesOfCommands, AListOfSomebodyElseIsLeftAlone) {
  fs::create_directory(place / "run");
  std::ofstream(place / "run" / ".pulvis-files") << "mine\n";
  for (const Words& more : {Words{}, Words{"--overwrite"}}) {
    const Outcome end = pulvis(short_run("run", more));
    EXPECT_EQ(end.code, 2) << end.err;
    EXPECT_THAT(end.err, HasSubstr("run/.pulvis-files: cannot list the files of the folder in it"));
    EXPECT_EQ(text_of(place / "run" / ".pulvis-files"), "mine\n");
    EXPECT_EQ(std::distance(fs::directory_iterator(place / "run"), fs::directory_iterator()), 1);
  }
}

TEST_F(OwnFilesOfCommands, WhatSomebodyChangedIsHis) {
  ASSERT_EQ(run("run").code, 0);
  for (const char* name :
       {"history.csv", "summary.json", "report.html", "scene.toml", "run.xdmf"}) {
    const std::string before = text_of(place / "run" / name);
    put(std::string("run/") + name, before + "\n");
    const Outcome end = run("run", {"--overwrite"});
    EXPECT_EQ(end.code, 2) << name;
    EXPECT_THAT(end.err, HasSubstr(name));
    EXPECT_EQ(text_of(place / "run" / name), before + "\n");
    put(std::string("run/") + name, before);
  }
  EXPECT_EQ(run("run", {"--overwrite"}).code, 0);
}

TEST_F(OwnFilesOfCommands, ResultsWithoutRunH5AreNotReplacedUnasked) {
  ASSERT_EQ(run("run").code, 0);
  fs::remove(place / "run/run.h5");
  const std::string history = text_of(place / "run/history.csv");
  EXPECT_EQ(run("run").code, 2);
  EXPECT_EQ(text_of(place / "run/history.csv"), history);
  EXPECT_EQ(run("run", {"--overwrite"}).code, 0);
}

TEST_F(OwnFilesOfCommands, StudiesReductionsAndRunsKeepOutOfEachOthersFolders) {
  ASSERT_EQ(run("run").code, 0);
  put("study.toml", "scene = \"" + scene("compaction/regular-25.toml") +
                        "\"\n[set]\nstage.press.duration = \"20 us\"\n"
                        "[grid]\ncontact.friction = [0.1]\n");
  expect_refused({"study", "study.toml", "-o", "run"}, "run/summary.json");
  expect_refused({"reduce", scene("lab/reduce.toml"), "-o", "run", "--overwrite"},
                 "run/summary.json");
  expect_refused({"study", "study.toml", "-o", "."}, "study.toml");
  put("s/friction=0.1/history.csv");
  expect_refused({"study", "study.toml", "-o", "s"}, "s/friction=0.1/history.csv");
}

TEST_F(OwnFilesOfCommands, AReductionLeavesItsSettings) {
  put("lab/reduce.toml", text_of(scene("lab/reduce.toml")));
  for (const auto& entry : fs::directory_iterator(scene("lab")))
    if (entry.path().extension() == ".csv")
      fs::copy_file(entry.path(), place / "lab" / entry.path().filename());
  expect_refused({"reduce", "lab/reduce.toml", "-o", "lab"}, "lab/reduce.toml");
  expect_refused({"reduce", "lab/reduce.toml", "-o", "lab", "--overwrite"}, "lab/reduce.toml");
}

TEST_F(OwnFilesOfCommands, APackingReplacesAPackingAndNothingElse) {
  fs::copy_file(scene("compaction/regular-25.toml"), place / "r.toml");
  expect_refused({"pack", "r.toml", "-o", "r.toml"}, "r.toml");
  put("data.csv");
  expect_refused({"pack", "r.toml", "-o", "data.csv"}, "data.csv");
  EXPECT_EQ(pulvis({"pack", "r.toml", "-o", "p.csv"}).code, 0);
  EXPECT_EQ(pulvis({"pack", "r.toml", "-o", "p.csv"}).code, 0);
  put("p.csv", text_of(place / "p.csv") + "# a note\n");
  expect_refused({"pack", "r.toml", "-o", "p.csv"}, "p.csv");
}

TEST_F(OwnFilesOfCommands, ReportsAndFiguresReplaceTheirOwnOnly) {
  ASSERT_EQ(run("run").code, 0);
  EXPECT_EQ(pulvis({"report", "run"}).code, 0);
  put("page.html");
  expect_refused({"report", "run", "-o", "page.html"}, "page.html");
  put("f.csv");
  const Words figure{"figure", "run", "--series", "dt", "-o"};
  expect_refused(with(figure, {"f.csv"}), "f.csv");
  EXPECT_EQ(pulvis(with(figure, {"g.csv"})).code, 0);
  EXPECT_EQ(pulvis(with(figure, {"g.csv"})).code, 0);
  put("run/report.html");
  expect_refused({"report", "run"}, "run/report.html");
}

}  // namespace
}  // namespace pulvis
