// Copies of the files that a scene names, in the run's folder: it stands alone, and nobody's file is replaced.
#include <gmock/gmock.h>

#include "scenes/read.hpp"
#include "tests/helpers/left.hpp"
#include "tests/helpers/program.hpp"

namespace pulvis {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

// Two grains, each traced in a file of its own.
std::string grains(const std::string& first, const std::string& second) {
  std::string text = R"(family = "compaction"
[[material]]
name = "steel"
density = "7850 kg/m^3"
youngs_modulus = "200 GPa"
poissons_ratio = 0.3
[[stage]]
name = "fly"
kind = "settle"
duration = "1 us"
[output]
frames = 1
samples = 2
)";
  int number = 0;
  for (const std::string& file : {first, second}) {
    const std::string name = "grain-" + std::to_string(++number);
    text += "[[particle]]\nname = \"" + name + "\"\nmaterial = \"steel\"\noutline = \"points\"\n" +
            "file = \"" + file + "\"\nmesh.size = \"2 mm\"\n[[body]]\nparticle = \"" + name +
            "\"\nposition = [\"" + std::to_string(30 * number) + " mm\", \"0 mm\"]\n";
  }
  return text;
}

class Inputs : public ProgramTest {
 protected:
  // An octagon's corners.
  void trace(const fs::path& file, double radius) const {
    fs::create_directories((place / file).parent_path());
    std::ofstream stream(place / file);
    stream << "x (mm), y (mm)\n";
    for (const auto& [x, y] : {std::pair{1.0, 0.0},
                               {0.7, 0.7},
                               {0.0, 1.0},
                               {-0.7, 0.7},
                               {-1.0, 0.0},
                               {-0.7, -0.7},
                               {0.0, -1.0},
                               {0.7, -0.7}})
      stream << radius * x << ", " << radius * y << "\n";
  }

  void write(const std::string& text) const { std::ofstream(place / "scene.toml") << text; }
  Outcome run(const Words& more = {}) const {
    Words words{"run", "scene.toml", "-o", "run"};
    words.insert(words.end(), more.begin(), more.end());
    return pulvis(words);
  }

  std::vector<fs::path> copies() const {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(place / "run" / "inputs"))
      files.push_back(entry.path());
    std::ranges::sort(files);
    return files;
  }
};

TEST_F(Inputs, TwoFilesOfOneNameAreKeptApart) {
  trace("a/grain.csv", 5);
  trace("b/grain.csv", 7);
  write(grains("a/grain.csv", "b/grain.csv"));
  ASSERT_EQ(run().code, 0);
  ASSERT_EQ(copies().size(), 2U);
  const std::string hash = left_in(place / "run").state_hash;
  for (const char* folder : {"a", "b"}) fs::remove_all(place / folder);
  ASSERT_EQ(pulvis({"run", "run/scene.toml", "-o", "again"}).code, 0);
  EXPECT_EQ(left_in(place / "again").state_hash, hash);
}

TEST_F(Inputs, OneFileNamedTwiceIsKeptOnce) {
  trace("grain.csv", 5);
  write(grains("grain.csv", "./grain.csv"));
  ASSERT_EQ(run().code, 0);
  EXPECT_EQ(copies().size(), 1U);
}

TEST_F(Inputs, NamesMayBeLongAndOfAnyLetters) {
  std::string name;
  for (int i = 0; i < 60; ++i) name += "ßü";
  trace(name + ".csv", 5);
  trace("with blanks 'and' [brackets].csv", 6);
  write(grains(name + ".csv", "with blanks 'and' [brackets].csv"));
  const Outcome outcome = run();
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(pulvis({"check", "run/scene.toml"}).code, 0);
}

TEST_F(Inputs, AnotherFileOfTheCopysNameIsNeverReplaced) {
  trace("grain.csv", 5);
  write(grains("grain.csv", "grain.csv"));
  ASSERT_EQ(run().code, 0);
  const fs::path copy = copies().front();
  std::ofstream(copy) << "somebody's notes";
  const Outcome outcome = run({"--overwrite"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("a different file is there already"));
  EXPECT_EQ(text_of(copy), "somebody's notes");
}

TEST_F(Inputs, ASavedSceneRunsAgainButNotOverItself) {
  trace("grain.csv", 5);
  write(grains("grain.csv", "grain.csv"));
  ASSERT_EQ(run().code, 0);
  const std::string hash = left_in(place / "run").state_hash;
  fs::remove(place / "grain.csv");
  const std::string saved = text_of(place / "run/scene.toml");
  const Outcome over = pulvis({"run", "run/scene.toml", "-o", "run", "--overwrite"});
  EXPECT_EQ(over.code, 2);
  EXPECT_THAT(over.err, HasSubstr("which is an input"));
  EXPECT_EQ(text_of(place / "run/scene.toml"), saved);
  const Outcome again = pulvis({"run", "run/scene.toml", "-o", "again"});
  ASSERT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(left_in(place / "again").state_hash, hash);
}

TEST_F(Inputs, ADamagedCopyIsNotResumed) {
  trace("grain.csv", 5);
  write(grains("grain.csv", "grain.csv"));
  ASSERT_EQ(run({"--stop-after", "2"}).code, 130);
  trace(copies().front(), 6);
  const Outcome outcome = pulvis({"resume", "run"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("the checkpoint belongs to another scene"));
}

// What `reduce` keeps does the same again without the records, those of the command line included.
TEST_F(Inputs, AReductionsSettingsStandAlone) {
  const std::string lab = scene("lab/");
  for (const char* file : {"synthetic-press-1.csv", "synthetic-logger-1.csv", "wedge-traces.csv"})
    fs::copy(lab + file, place / file);
  const Words friction{
      "synthetic-press-1.csv", "synthetic-logger-1.csv", "--set", "compact.length=10 mm", "--set",
      "compact.powder=316L"};
  const std::map<std::string, Words> reductions{{"curves.csv", friction},
                                                {"facets.csv", {"wedge-traces.csv"}}};
  for (const auto& [result, files] : reductions) {
    Words words{"reduce", "-o", "first-" + result};
    words.insert(words.end(), files.begin(), files.end());
    const Outcome first = pulvis(words);
    ASSERT_EQ(first.code, 0) << first.err;
  }
  for (const char* file : {"synthetic-press-1.csv", "synthetic-logger-1.csv", "wedge-traces.csv"})
    fs::remove(place / file);
  for (const auto& [result, files] : reductions) {
    const Outcome again =
        pulvis({"reduce", "first-" + result + "/reduce.toml", "-o", "again-" + result});
    ASSERT_EQ(again.code, 0) << again.err;
    EXPECT_EQ(text_of(place / ("again-" + result) / result),
              text_of(place / ("first-" + result) / result));
    EXPECT_EQ(text_of(place / ("again-" + result) / "reduce.toml"),
              text_of(place / ("first-" + result) / "reduce.toml"));
  }
}

}  // namespace
}  // namespace pulvis
