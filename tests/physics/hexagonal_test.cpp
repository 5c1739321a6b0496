// Hexagonal packings under a punch: what lies symmetric between the walls stays so.
#include <gtest/gtest.h>

#include <numbers>

#include "scenes/packing/place.hpp"
#include "tests/helpers/experiment.hpp"
#include "tests/helpers/paths.hpp"

namespace pulvis {
namespace {

// 5 rows of 4 and 3 in turn, pressed by 3% of their height.
const std::vector<std::string> small{"packing[0].rows=5",
                                     "packing[0].columns=4",
                                     "tool.right.point=[\"40 mm\", \"0 mm\"]",
                                     "tool.top.point=[\"0 mm\", \"44.641016152 mm\"]",
                                     "stage.press.duration=0.6 ms",
                                     "stage.press.move[0].displacement=[\"0 mm\", \"-1.3 mm\"]"};

TEST(Hexagonal, PushesBothWallsAlike) {
  Experiment e("compaction/hexagonal-1683.toml", small);
  double maximum = 0;
  e.run(50, [&] {
    const double left = -e.value("tool/left/force_x"), right = e.value("tool/right/force_x");
    maximum = std::max(maximum, right);
    EXPECT_NEAR(left, right, 1e-6 * maximum);
  });
  EXPECT_GT(maximum, 1e3);
  EXPECT_GT(e.results.energies().plastic, 10 * e.results.energies().elastic);
  EXPECT_NEAR(e.value("relative_density"), 18 * std::numbers::pi * 25 / (40 * (44.641016152 - 1.3)),
              1e-3);
}

TEST(Hexagonal, TheShippedSceneHasAsManyParticlesAsItsNameSays) {
  const Scene scene = read_scene(paths::source_dir() + "/scenes/compaction/hexagonal-1683.toml");
  EXPECT_EQ(place_bodies(scene).size(), 1683U);
}

}  // namespace
}  // namespace pulvis
