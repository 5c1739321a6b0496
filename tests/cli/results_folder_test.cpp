// Where the results of a file go that are given no folder.
#include <gmock/gmock.h>

#include "tests/helpers/program.hpp"

namespace pulvis {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

using ResultsFolder = ProgramTest;

// "..toml" is named "." and "...toml" "..": their results would lie in runs/ itself, or beside it.
TEST_F(ResultsFolder, NamesOfOnlyDotsGiveNone) {
  const std::string text = text_of(scene("compaction/regular-25.toml"));
  for (const char* name : {"..toml", "...toml"}) {
    std::ofstream(place / name) << text;
    const Outcome refused = pulvis(with({"run", name}, quick()));
    EXPECT_EQ(refused.code, 2) << name;
    EXPECT_THAT(refused.err, HasSubstr("allowed: -o FOLDER, or a file name that begins with more "
                                       "than dots"));
    EXPECT_FALSE(fs::exists(place / "runs")) << name;
    EXPECT_FALSE(fs::exists(place / "run.h5")) << name;
  }
}

TEST_F(ResultsFolder, OtherOddNamesGiveTheirOwn) {
  const std::string text = text_of(scene("compaction/regular-25.toml"));
  std::ofstream(place / ".toml") << text;
  EXPECT_EQ(pulvis(with({"run"}, with(quick(), {".toml"}))).code, 0);
  EXPECT_TRUE(fs::exists(place / "runs" / ".toml" / "run.h5"));
  std::ofstream(place / "-a b.toml") << text;
  EXPECT_EQ(pulvis(with({"run"}, with(quick(), {"--", "-a b.toml"}))).code, 0);
  EXPECT_TRUE(fs::exists(place / "runs" / "-a b" / "run.h5"));
}

}  // namespace
}  // namespace pulvis
