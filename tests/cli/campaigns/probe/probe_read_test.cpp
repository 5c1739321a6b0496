// The reference of the probe's keys, and the scenes that a probe makes of a path.
#include "cli/campaigns/probe/probe_read.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "cli/campaigns/probe/probe_scenes.hpp"
#include "tests/helpers/paths.hpp"
#include "tests/helpers/wrong.hpp"

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
    EXPECT_EQ(loading.stages[i].cell->stress[0], -200e6);
  }
}

TEST(ProbeScenes, HaveOneSeed) {
  const std::string file = paths::source_dir() + "/scenes/probes/cap.toml";
  const std::string wrong = message_of([&] { load_probe(file, {"seed=7"}); });
  EXPECT_NE(wrong.find("--set seed=7: seed: the probe has its own `seeds`"), std::string::npos)
      << wrong;
}

TEST(ProbeScenes, HaveEachSeedOnce) {
  namespace fs = std::filesystem;
  const fs::path file =
      fs::temp_directory_path() / ("pulvis-seeds" + std::to_string(getpid()) + ".toml");
  std::ofstream(file) << "seeds = [1, 1]\ndensities = [0.9]\n[[path]]\nname = \"isostatic\"\n"
                         "scene = \"isostatic.toml\"\n[probe]\nduration = \"0.2 ms\"\n";
  const std::string wrong = message_of([&] { load_probe(file); });
  EXPECT_NE(wrong.find(":1:9: seeds: a seed is given twice, allowed: each once"), std::string::npos)
      << wrong;
  fs::remove(file);
}

// Directions, yield surfaces and moduli are of plane strain.
TEST(ProbeScenes, HaveTwoDimensions) {
  namespace fs = std::filesystem;
  const fs::path file =
      fs::temp_directory_path() / ("pulvis-spheres" + std::to_string(getpid()) + ".toml");
  std::ofstream(file) << "densities = [0.7]\n[[path]]\nname = \"spheres\"\nscene = \""
                      << paths::source_dir()
                      << "/scenes/periodic/spheres-shear.toml\"\n[probe]\nduration = \"1 us\"\n";
  const std::string wrong = message_of([&] { load_probe(file); });
  EXPECT_NE(wrong.find("it has three dimensions"), std::string::npos) << wrong;
  fs::remove(file);
}

// By strain and by stress, in a direction and in shear.
TEST(ProbeScenes, ProbeAsTheyAreAsked) {
  Probe probe = load_probe(paths::source_dir() + "/scenes/probes/cap.toml");
  const ProbeStart start{"state-0.9.h5", {-60e6, -70e6}, 64e6};
  const auto drive = [&](std::optional<double> angle) {
    const std::string text = probing_scene(probe.loadings[0].scene, probe.spec, start, angle);
    const auto root = document::parse(text);
    const auto& stages = document::find(root, "stage")->value.get<document::Array>();
    EXPECT_EQ(stages.size(), 2U);
    EXPECT_EQ(*document::find_text(root, "initial_state"), start.state);
    const auto& release = document::find(stages[0].get<document::Table>(), "cell")->value;
    EXPECT_EQ(*document::find_text(release.get<document::Table>(), "stress_yy"), "-35000000 Pa");
    return document::find(stages[1].get<document::Table>(), "cell")->value.get<document::Table>();
  };
  EXPECT_EQ(document::find(drive(0.0), "strain_xx")->value.get<double>(), probe.spec.size);
  EXPECT_EQ(document::find(drive({}), "strain_xy")->value.get<double>(), probe.spec.size);
  probe.spec.control = ProbeSpec::Control::stress;
  probe.spec.size = 0.5;
  EXPECT_EQ(*document::find_text(drive(0.0), "stress_xx"), "2000000 Pa");  // -30 + 0.5 64 MPa
  EXPECT_EQ(*document::find_text(drive({}), "stress_xy"), "32000000 Pa");
  EXPECT_EQ(document::find(drive({}), "strain_xy"), nullptr);
}

}  // namespace
}  // namespace pulvis
