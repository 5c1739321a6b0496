// A lever whose stiffness is that of its mesh: a warning that no option suppresses.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "scenes/lever/mesh_error.hpp"
#include "tests/helpers/paths.hpp"
#include "tests/helpers/program.hpp"

namespace pulvis {
namespace {

using ::testing::HasSubstr;

TEST(MeshWarning, IsGivenFromFivePercentOn) {
  EXPECT_EQ(mesh_warning({0.049, 0.02, 0.01}), "");
  EXPECT_THAT(mesh_warning({0.01, 0.05, 0.01}), HasSubstr("5% (k_l)"));
  EXPECT_THAT(mesh_warning({0.01, 0.02, 0.59}),
              HasSubstr("59% (k_x), usual: < 5%; smaller edges reduce it"));
  EXPECT_THAT(mesh_warning({5.5, 0.02, 0.01}), HasSubstr("550% (k_n)"));
  EXPECT_THAT(mesh_warning({5.5, 0.02, 0.01}), HasSubstr("this is no stiffness of the lever"));
}

class LeverMeshes : public ProgramTest {};

// A beam shorter than it is thick has no stiffness that its mesh would not change: it was told only in a line that
// --quiet leaves out.
TEST_F(LeverMeshes, AStiffnessThatIsTheMeshsIsToldAlsoQuietly) {
  const std::string scene =
      (std::filesystem::path(paths::source_dir()) / "scenes/afm/tipless-beam.toml").string();
  for (const char* how : {"--quiet", "--json"}) {
    const Outcome outcome = pulvis({"run", scene, how, "-o", "done", "--overwrite", "--set",
                                    "lever.length=2 um", "--set", "lever.side_aspect=20"});
    EXPECT_NE(outcome.code, 2) << outcome.err;  // the scene's expectations are not met
    EXPECT_THAT(outcome.err, HasSubstr("the mesh makes the lever too stiff by about"));
    EXPECT_THAT(outcome.err, HasSubstr("this is no stiffness of the lever"));
  }
}

}  // namespace
}  // namespace pulvis
