// The reference of the probe's keys, and the scenes that a probe makes of a path.
#include "cli/campaigns/probe/probe_read.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "cli/campaigns/probe/probe_directions.hpp"
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

class ProbeFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    place = std::filesystem::temp_directory_path() / ("pulvis-probes" + std::to_string(getpid()));
    std::filesystem::create_directory(place);
  }
  void TearDown() override { std::filesystem::remove_all(place); }
  // With a path in each of these dimensions.
  std::filesystem::path written(const std::string& probe, std::vector<int> dimensions) const {
    std::ofstream file(place / "probe.toml");
    file << "densities = [0.9]\n";
    for (const int dimension : dimensions)
      file << "[[path]]\nname = \"" << dimension << "D\"\nscene = \"" << paths::source_dir()
           << "/scenes/periodic/" << (dimension == 3 ? "spheres-shear" : "cap-isostatic")
           << ".toml\"\n";
    file << "[probe]\nduration = \"1 us\"\n" << probe;
    return place / "probe.toml";
  }
  std::string refusal(const std::string& probe, std::vector<int> dimensions) const {
    return message_of([&] { load_probe(written(probe, std::move(dimensions))); });
  }
  std::filesystem::path place;
};

TEST_F(ProbeFiles, AreReadInBothDimensions) {
  const Probe probe = load_probe(written("directions = 8\ndeviatoric = 3\n", {2, 3}));
  ASSERT_EQ(probe.loadings.size(), 2U);
  EXPECT_EQ(directions_of(probe.spec, false).size(), 9U);
  EXPECT_EQ(directions_of(probe.spec, true).size(), 14U);
}

TEST_F(ProbeFiles, HaveDirectionsThatTheirPathsHave) {
  EXPECT_NE(refusal("deviatoric = 6\n", {2}).find("probe.deviatoric: no path has three"),
            std::string::npos);
  const std::string oblique = "[[direction]]\nname = \"oblique\"\nxx = -1\nzz = 0.5\n";
  EXPECT_NE(refusal(oblique, {2}).find("direction[0].zz: a path has two dimensions"),
            std::string::npos);
  EXPECT_EQ(refusal(oblique, {3}), "");
  EXPECT_NE(refusal(oblique + oblique, {3}).find("'oblique' is the name of another direction"),
            std::string::npos);
  EXPECT_NE(
      refusal("[[direction]]\nname = \"release\"\nxx = 1\n", {3}).find("the run that unloads"),
      std::string::npos);
  EXPECT_NE(refusal("[[direction]]\nname = \"none\"\n", {3}).find("all components are zero"),
            std::string::npos);
  EXPECT_NE(refusal("[[direction]]\nname = \"shear_xy\"\nxy = 1\n", {3})
                .find("the name of a direction that is probed anyway"),
            std::string::npos);
}

// In three dimensions all are unit vectors, deviatoric ones keep the volume, and the axial plane has isotropic compression.
TEST(ProbeDirections, AreUnitVectors) {
  ProbeSpec spec;
  spec.given.push_back({"oblique", {-2, 0, 1, 0, 0, 0.5}, {}});
  for (const bool in_space : {false, true})
    for (const ProbeDirection& direction : directions_of(spec, in_space)) {
      EXPECT_NEAR(direction.unit.norm(), 1, 1e-12) << direction.name;
      if (direction.set == ProbeDirection::Set::deviatoric) {
        EXPECT_NEAR(pressure_of(direction.unit), 0, 1e-12) << direction.name;
      }
      if (direction.set == ProbeDirection::Set::axial && in_space) {
        EXPECT_NEAR(direction.unit[0], direction.unit[1], 1e-12) << direction.name;
      }
    }
  const std::vector<ProbeDirection> all = directions_of(spec, true);
  const auto lode = std::ranges::find(all, "lode=120", &ProbeDirection::name);
  ASSERT_NE(lode, all.end());
  EXPECT_NEAR(lode->unit[1], -std::sqrt(2.0 / 3), 1e-12);  // compressed along y
  EXPECT_NEAR(lode_angle(lode->unit), lode->angle, 1e-12);
}

// By strain and by stress, in a direction and in shear, from the state that is unloaded first.
TEST(ProbeScenes, ProbeAsTheyAreAsked) {
  Probe probe = load_probe(paths::source_dir() + "/scenes/probes/cap.toml");
  const LoadedScene& scene = probe.loadings[0].scene;
  const ProbeStart start{"state-0.9.h5", mandel_of({-60e6, -70e6, -62e6}), 64e6};
  const auto cell_of = [&](const std::string& text) {
    const auto root = document::parse(text);
    const auto& stages = document::find(root, "stage")->value.get<document::Array>();
    EXPECT_EQ(stages.size(), 1U);
    EXPECT_EQ(*document::find_text(root, "initial_state"), start.file);
    return document::find(stages[0].get<document::Table>(), "cell")->value.get<document::Table>();
  };
  const document::Table release = cell_of(release_scene(scene, probe.spec, start));
  EXPECT_EQ(*document::find_text(release, "stress_yy"), "-35000000 Pa");
  EXPECT_EQ(document::find(release, "stress_xy"), nullptr);
  EXPECT_EQ(document::find(release, "stress_zz"), nullptr);
  ProbeStart sheared = start;
  sheared.stress[3] = 10e6;
  EXPECT_NE(document::find(cell_of(release_scene(scene, probe.spec, sheared)), "stress_xy"),
            nullptr);

  const std::vector<ProbeDirection> all = directions_of(probe.spec, false);
  const auto drive = [&](const ProbeDirection& direction) {
    return cell_of(probing_scene(scene, probe.spec, start, direction));
  };
  const ProbeDirection &along_x = all.front(), &shear = all.back();
  EXPECT_EQ(document::find(drive(along_x), "strain_xx")->value.get<double>(), probe.spec.size);
  EXPECT_NEAR(document::find(drive(shear), "strain_xy")->value.get<double>(),
              probe.spec.size / std::sqrt(2), 1e-12);
  probe.spec.control = ProbeSpec::Control::stress;
  probe.spec.size = 0.5;
  EXPECT_EQ(*document::find_text(drive(along_x), "stress_xx"), "-28000000 Pa");  // -60 + 0.5 64 MPa
  EXPECT_EQ(*document::find_text(drive(along_x), "stress_yy"), "-70000000 Pa");
  EXPECT_EQ(*document::find_text(drive(shear), "stress_xx"), "-60000000 Pa");
  EXPECT_NE(document::find(drive(shear), "stress_xy"), nullptr);
  EXPECT_EQ(document::find(drive(shear), "strain_xy"), nullptr);
}

}  // namespace
}  // namespace pulvis
