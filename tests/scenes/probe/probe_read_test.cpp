// The reference of the probe's keys, and the scenes that a probe makes of a path.
#include "scenes/probe/probe_read.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "scenes/probe/probe_scenes.hpp"
#include "tests/helpers/paths.hpp"

namespace pulvis {
namespace {

TEST(ProbeReference, IsTheOneInTheDocs) {
  std::ostringstream text;
  text << std::ifstream(paths::source_dir() + "/docs/probe.md").rdbuf();
  EXPECT_EQ(probe_reference(), text.str()) << "pulvis probe --reference text > docs/probe.md";
}

// The last stage of the path once for every density.
TEST(ProbeScenes, LoadToEveryDensity) {
  const Probe probe = load_probe(paths::source_dir() + "/scenes/probes/cap.toml");
  ASSERT_EQ(probe.loadings.size(), 4U);
  EXPECT_EQ(probe.loadings[1].name, "isostatic,seed=2");
  EXPECT_EQ(probe.loadings[1].scene.scene.seed, 2U);
  const Scene loading =
      load_scene_text(loading_scene(probe.loadings[0].scene, probe.spec), "loading.toml").scene;
  ASSERT_EQ(loading.stages.size(), 3U);
  EXPECT_TRUE(loading.expects.empty());
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(loading.stages[i].until->relative_density, probe.spec.densities[i]);
    EXPECT_TRUE(loading.stages[i].keep_state);
    EXPECT_EQ(loading.stages[i].cell->stress_xx, -200e6);
  }
}

}  // namespace
}  // namespace pulvis
