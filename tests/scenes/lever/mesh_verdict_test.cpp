// A lever whose stiffness is that of its mesh: a warning that no option suppresses, or no result.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "scenes/lever/mesh_error.hpp"
#include "tests/helpers/paths.hpp"
#include "tests/helpers/program.hpp"

namespace pulvis {
namespace {

using ::testing::HasSubstr;

TEST(MeshVerdict, WarnsFromFivePercentAndFailsFromSixty) {
  EXPECT_EQ(judged({0.049, 0.02, 0.01}).warning, "");
  EXPECT_THAT(judged({0.01, 0.05, 0.01}).warning, HasSubstr("5% (k_l)"));
  EXPECT_EQ(judged({0.01, 0.05, 0.01}).failure, "");
  EXPECT_THAT(judged({0.01, 0.02, 0.59}).warning, HasSubstr("59% (k_x), usual: < 5%"));
  EXPECT_THAT(judged({5.5, 0.02, 0.01}).failure, HasSubstr("550% (k_n)"));
  EXPECT_EQ(judged({5.5, 0.02, 0.01}).warning, "");
}

class LeverMeshes : public ProgramTest {};

// A beam shorter than it is thick has no stiffness that its mesh would not change: it was told only in a line that
// --quiet leaves out.
TEST_F(LeverMeshes, AStiffnessThatIsTheMeshsIsRefusedAlsoQuietly) {
  const std::string scene =
      (std::filesystem::path(paths::source_dir()) / "scenes/afm/tipless-beam.toml").string();
  for (const char* how : {"--quiet", "--json"}) {
    const Outcome outcome = pulvis({"run", scene, how, "-o", "done", "--overwrite", "--set",
                                    "lever.length=2 um", "--set", "lever.side_aspect=20"});
    EXPECT_EQ(outcome.code, 3) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("the mesh makes the lever too stiff by about"));
    EXPECT_THAT(outcome.err, HasSubstr("allowed: < 60%"));
  }
}

}  // namespace
}  // namespace pulvis
