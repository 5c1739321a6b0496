// Pulvis's own files are those that hold what it wrote, in the role that it wrote them in: nothing else is ever
// replaced or removed.
#include "engine/files/own_files.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <sstream>

namespace pulvis {
namespace {

namespace fs = std::filesystem;

class OwnFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    folder = fs::temp_directory_path() / ("pulvis-own-" + std::to_string(getpid()));
    fs::remove_all(folder);
    fs::create_directories(folder);
    file = folder / "summary.json";
  }
  void TearDown() override { fs::remove_all(folder); }

  static void put(const fs::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
  }
  static std::string text_of(const fs::path& path) {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return text.str();
  }
  void expect_refused(const fs::path& path) const {
    const std::string before = text_of(path);
    EXPECT_THROW(write_own(path, role::run, "new"), ForeignFile);
    EXPECT_THROW(replace_own(path, role::run, "new"), ForeignFile);
    remove_own(path, role::run);
    EXPECT_EQ(text_of(path), before);
  }

  fs::path folder, file;
};

TEST_F(OwnFiles, WhatWasWrittenIsReplacedAndRemoved) {
  write_own(file, role::run, "first");
  EXPECT_TRUE(is_own(file, role::run));
  write_own(file, role::run, "second");
  EXPECT_EQ(text_of(file), "second");
  remove_own(file, role::run);
  EXPECT_FALSE(fs::exists(file));
}

TEST_F(OwnFiles, AListOfSomebodyElseIsLeftAlone) {
  const fs::path list = folder / ".pulvis-files";
  for (const std::string text : {"my notes", "my notes\n", "next week: dentist\n", "\n"}) {
    put(list, text);
    EXPECT_THROW(require_own_list_in(folder), ForeignFile) << text;
    EXPECT_THROW(write_own(file, role::run, "new"), ForeignFile) << text;
    remove_own_below(folder, role::run);
    EXPECT_EQ(text_of(list), text);
    EXPECT_FALSE(fs::exists(file));
  }
  fs::remove(list);
  fs::create_directory(list);
  EXPECT_THROW(write_own(file, role::run, "new"), ForeignFile);
}

// A full disk cuts a line short: also the first one.
TEST_F(OwnFiles, ALineThatWasCutShortIsIgnored) {
  const fs::path list = folder / ".pulvis-files";
  write_own(file, role::run, "first");
  const std::string whole = text_of(list);
  for (const std::size_t bytes : {std::size_t{7}, std::size_t{25}}) {
    put(list, whole.substr(0, bytes));
    fs::remove(file);
    write_own(file, role::run, "second");
    EXPECT_TRUE(is_own(file, role::run));
    put(list, whole + whole.substr(0, bytes));
    fs::remove(file);
    write_own(file, role::run, "third");
    EXPECT_TRUE(is_own(file, role::run));
  }
}

TEST_F(OwnFiles, WhatSomebodyPutThereOrChangedIsHis) {
  put(file, "mine");
  expect_refused(file);
  fs::remove(file);
  write_own(file, role::run, "written");
  put(file, "writteN");
  expect_refused(file);
  put(file, "written and more");
  expect_refused(file);
  put(file, "");
  expect_refused(file);
}

TEST_F(OwnFiles, EveryRoleIsItsOwn) {
  write_own(file, role::study, "of a study");
  EXPECT_TRUE(is_own(file, role::study));
  expect_refused(file);
}

TEST_F(OwnFiles, LinksAndFoldersAreNobodysAndHardLinksKeepTheirText) {
  put(folder / "data", "precious");
  fs::create_symlink(folder / "data", file);
  expect_refused(file);
  EXPECT_EQ(text_of(folder / "data"), "precious");
  fs::remove(file);
  fs::create_directory(file);
  EXPECT_THROW(require_own_or_none(file, role::run), ForeignFile);
  fs::remove(file);
  write_own(file, role::run, "first");
  fs::create_hard_link(file, folder / "kept");
  write_own(file, role::run, "second");
  EXPECT_EQ(text_of(folder / "kept"), "first");
}

// A history has grown on when its program was killed; when it was finished, every byte counts.
TEST_F(OwnFiles, AFileThatGrowsIsKnownByItsBeginning) {
  const fs::path history = folder / "history.csv";
  write_own(history, role::run, "time [s]\n", Extent::start);
  put(history, "time [s]\n0\n1\n");
  EXPECT_TRUE(is_own(history, role::run));
  put(history, "my time\n0\n1\n");
  EXPECT_FALSE(is_own(history, role::run));
  put(history, "time [s]\n0\n");
  note_own(history, role::run, "time [s]\n0\n", Extent::whole);
  EXPECT_TRUE(is_own(history, role::run));
  put(history, "time [s]\n0\n1\n");
  EXPECT_FALSE(is_own(history, role::run));
}

// Killed before the rename the old text is in its place, killed after it the new one.
TEST_F(OwnFiles, AKillWhileAFileIsReplacedLocksNobodyOut) {
  write_own(file, role::run, "old");
  const fs::path beside = begin_own(file, role::run, "new");
  EXPECT_TRUE(is_own(file, role::run));
  put(beside, "new");
  fs::rename(beside, file);
  EXPECT_TRUE(is_own(file, role::run));
  put(file, "mine");
  EXPECT_FALSE(is_own(file, role::run));
}

TEST_F(OwnFiles, FilesOfHdf5SayThemselvesWhatTheyAre) {
  const fs::path run = folder / "run.h5", checkpoint = folder / "checkpoint-000000000007.h5";
  put(run, "\x89HDF\r\n\x1a\n and somebody's data");
  put(checkpoint, "not of Pulvis");
  expect_refused(run);
  EXPECT_FALSE(is_own(checkpoint, role::run));
  put(run, "pulvis run 1\n and what HDF5 makes of it");
  put(checkpoint, "pulvis checkpoint 1\n");
  EXPECT_TRUE(is_own(run, role::run));
  EXPECT_TRUE(is_own(checkpoint, role::run));
  put(folder / "checkpoint-000000000007.h5.new", "");
  EXPECT_TRUE(is_own(folder / "checkpoint-000000000007.h5.new", role::run));
}

TEST_F(OwnFiles, WhatIsReadIsNotWrittenWhateverPathLeadsThere) {
  const fs::path scene = folder / "scene.toml";
  put(scene, "a scene");
  fs::create_directory(folder / "sub");
  fs::create_hard_link(scene, folder / "sub" / "other.toml");
  fs::create_symlink(folder, folder / "way");
  for (const fs::path& read : {scene, folder / "sub" / "other.toml", folder / "way" / "scene.toml",
                               folder / "sub" / ".." / "scene.toml"})
    EXPECT_THROW(require_another(read, scene), ForeignFile) << read;
  require_another(folder / "sub" / "none.toml", scene);
}

TEST_F(OwnFiles, AFolderKeepsWhatIsNotPulviss) {
  const fs::path pictures = folder / "pictures";
  fs::create_directory(pictures);
  write_own(pictures / "force.png", role::figure, "drawn");
  put(pictures / "mine.png", "mine");
  remove_own_below(pictures, role::figure);
  EXPECT_FALSE(fs::exists(pictures / "force.png"));
  EXPECT_EQ(text_of(pictures / "mine.png"), "mine");
  fs::remove(pictures / "mine.png");
  remove_own_below(pictures, role::figure);
  EXPECT_FALSE(fs::exists(pictures));
}

}  // namespace
}  // namespace pulvis
