// A journaled file is as it was after its last commit, wherever the program died since.
#include "engine/files/journaled_file.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <sstream>
#include <string>

namespace pulvis {
namespace {

namespace fs = std::filesystem;

class JournaledFileTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder = fs::temp_directory_path() /
             ("pulvis-journal-" + std::to_string(getpid()) + "-" + test->name());
    fs::create_directories(folder);
    path = folder / "file";
  }
  void TearDown() override { fs::remove_all(folder); }

  static void put(JournaledFile& file, std::uint64_t at, const std::string& text) {
    file.write(at, std::as_bytes(std::span(text)));
  }
  static std::string got(const JournaledFile& file, std::uint64_t at, std::size_t size) {
    std::string text(size, '?');
    file.read(at, std::as_writable_bytes(std::span(text)));
    return text;
  }
  std::string on_disk(const char* name = "file") const {
    std::ostringstream text;
    text << std::ifstream(folder / name, std::ios::binary).rdbuf();
    return text.str();
  }

  fs::path folder, path;
};

TEST_F(JournaledFileTest, ReadsWhatWasWrittenBeforeAndAfterTheCommit) {
  JournaledFile file(path, JournaledFile::Open::empty);
  put(file, 0, "first state");
  file.commit();
  put(file, 6, "words, and more");
  EXPECT_EQ(got(file, 0, 21), "first words, and more");
  EXPECT_EQ(on_disk().substr(0, 11), "first state");  // others still see the last commit
  EXPECT_EQ(got(file, 100, 3), std::string(3, '\0'));
  file.commit();
  EXPECT_EQ(on_disk(), "first words, and more");
}

TEST_F(JournaledFileTest, ChangesOverManyPagesComeTogether) {
  const std::string before(20000, 'a'), after(9000, 'b');
  JournaledFile file(path, JournaledFile::Open::empty);
  put(file, 0, before);
  file.commit();
  put(file, 4000, after);
  put(file, 4090, "cc");
  EXPECT_EQ(on_disk(), before);
  file.commit();
  std::string expected = before;
  expected.replace(4000, after.size(), after).replace(4090, 2, "cc");
  EXPECT_EQ(on_disk(), expected);
  EXPECT_EQ(got(file, 0, expected.size()), expected);
}

TEST_F(JournaledFileTest, WithoutACommitNothingIsLeftOfAChange) {
  {
    JournaledFile file(path, JournaledFile::Open::empty);
    put(file, 0, "kept");
    file.commit();
    put(file, 0, "lost");
    file.close();
  }
  EXPECT_EQ(on_disk(), "kept");
  EXPECT_FALSE(fs::exists(folder / "file.journal"));
}

// What a kill between the journal and its application leaves: the journal of "new" and the file of "old".
TEST_F(JournaledFileTest, AJournalThatWasNotAppliedIsAppliedOnOpening) {
  {
    JournaledFile file(path, JournaledFile::Open::empty);
    put(file, 0, "old text");
    file.commit();
    put(file, 0, "new");
    file.commit();
    fs::copy_file(folder / "file.journal", folder / "saved");
    file.close();
  }
  std::ofstream(path, std::ios::binary) << "old text and what nobody refers to";
  fs::rename(folder / "saved", folder / "file.journal");
  JournaledFile file(path, JournaledFile::Open::existing);
  EXPECT_EQ(got(file, 0, 8), "new text");
  EXPECT_EQ(file.size(), 8U);
}

TEST_F(JournaledFileTest, AJournalThatIsNotWholeIsNoCommit) {
  {
    JournaledFile file(path, JournaledFile::Open::empty);
    put(file, 0, "old text");
    file.commit();
    put(file, 0, "new");
    file.commit();
    fs::copy_file(folder / "file.journal", folder / "saved");
    file.close();
  }
  const std::string journal = on_disk("saved");
  for (std::size_t size :
       {std::size_t{0}, std::size_t{10}, journal.size() / 2, journal.size() - 1}) {
    std::ofstream(path, std::ios::binary) << "old text";
    std::ofstream(folder / "file.journal", std::ios::binary) << journal.substr(0, size);
    JournaledFile file(path, JournaledFile::Open::existing);
    EXPECT_EQ(got(file, 0, 8), "old text") << size;
  }
  for (std::size_t at = 0; at < journal.size(); at += 97) {
    std::string flipped = journal;
    flipped[at] = static_cast<char>(flipped[at] ^ 4);
    std::ofstream(path, std::ios::binary) << "old text";
    std::ofstream(folder / "file.journal", std::ios::binary) << flipped;
    JournaledFile file(path, JournaledFile::Open::existing);
    EXPECT_EQ(got(file, 0, 8), "old text") << at;
  }
  constexpr std::size_t top = 7;  // the byte of a word with its highest bit
  for (std::size_t a = 40 + top; a + 8 < journal.size(); a += 408)
    for (std::size_t b = a + 8; b < journal.size(); b += 1016) {
      std::string flipped = journal;
      for (const std::size_t at : {a, b}) flipped[at] = static_cast<char>(flipped[at] ^ 0x80);
      std::ofstream(path, std::ios::binary) << "old text";
      std::ofstream(folder / "file.journal", std::ios::binary) << flipped;
      JournaledFile file(path, JournaledFile::Open::existing);
      EXPECT_EQ(got(file, 0, 8), "old text") << a << " and " << b;
    }
}

TEST_F(JournaledFileTest, MissingFileAndFolderAreErrors) {
  EXPECT_THROW(JournaledFile(path, JournaledFile::Open::existing), std::system_error);
  EXPECT_THROW(JournaledFile(folder / "no" / "file", JournaledFile::Open::empty),
               std::system_error);
}

// Every commit fills the file with one letter. Wherever the writer is killed, opening finds one letter.
TEST_F(JournaledFileTest, AKilledWriterLeavesAWholeState) {
  constexpr std::size_t size = 30000;
  for (int round = 0; round < 20; ++round) {
    const pid_t writer = fork();
    if (writer == 0) {
      JournaledFile file(path, JournaledFile::Open::empty);
      for (int i = 0;; ++i) {
        put(file, 0, std::string(size, static_cast<char>('a' + i % 26)));
        file.commit();
      }
    }
    usleep(static_cast<useconds_t>(5000 + 1371 * round));
    kill(writer, SIGKILL);
    waitpid(writer, nullptr, 0);
    if (!fs::exists(path)) continue;
    const JournaledFile file(path, JournaledFile::Open::existing);
    if (file.size() < size) continue;  // killed in its first commit
    const std::string text = got(file, 0, size);
    EXPECT_EQ(text, std::string(size, text[0])) << "round " << round;
  }
}

}  // namespace
}  // namespace pulvis
