// What a scene file says reaches the Scene: units, defaults, overrides, references, and the text
// and hash of the scene as run.
#include "scenes/read.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <numbers>
#include <set>

#include "cli/save_scene.hpp"
#include "tests/helpers/paths.hpp"
#include "tests/helpers/shipped_scenes.hpp"
#include "tests/helpers/wrong.hpp"

namespace pulvis {
namespace {

using testing::HasSubstr;

const std::filesystem::path folder = std::filesystem::path(paths::source_dir()) / "scenes";

constexpr const char* smallest = R"(family = "compaction"
[[material]]
name = "steel"
density = "7850 kg/m^3"
youngs_modulus = "200 GPa"
poissons_ratio = 0.3
[[particle]]
name = "disc"
material = "steel"
outline = "disc"
diameter = "10 mm"
[[packing]]
kind = "square"
particle = "disc"
rows = 2
columns = 3
[[stage]]
name = "rest"
kind = "settle"
duration = "1 ms"
)";

TEST(Read, DefaultsOfTheDeclarationsAreThoseOfTheStruct) {
  const Scene read = load_scene_text(smallest, "smallest.toml").scene;
  const Scene plain;
  EXPECT_EQ(read.thickness, plain.thickness);
  EXPECT_EQ(read.seed, plain.seed);
  EXPECT_EQ(read.contact.friction, plain.contact.friction);
  EXPECT_EQ(read.contact.stiffness, 14);  // scenes/checks/contact_defaults.cpp
  EXPECT_EQ(read.contact.damping, plain.contact.damping);
  EXPECT_EQ(read.time.safety, plain.time.safety);
  EXPECT_EQ(read.output.frames, plain.output.frames);
  EXPECT_EQ(read.output.samples, plain.output.samples);
  EXPECT_EQ(read.limits.energy_balance, plain.limits.energy_balance);
  EXPECT_EQ(read.limits.penetration, plain.limits.penetration);
  EXPECT_EQ(read.limits.kinetic_energy, std::nullopt);
  EXPECT_EQ(read.materials.at(0).yield_stress, std::nullopt);
  const auto& mesh = std::get<DiscMesh>(read.particles.at(0).mesh);
  EXPECT_EQ(mesh.refinement, DiscMesh{}.refinement);
}

TEST(Read, ASpacingNotGivenIsTheDiameter) {
  EXPECT_EQ(load_scene_text(smallest, "s.toml").scene.packings.at(0).spacing, 0.01);
}

TEST(Read, ValuesReferencesAndMarks) {
  const Scene scene = read_scene(folder / "basic" / "sliding-block.toml");
  EXPECT_EQ(scene.title, "Sliding block");
  EXPECT_EQ(scene.materials.at(0).youngs_modulus, 200e9);
  EXPECT_EQ(std::get<RectangleOutline>(scene.particles.at(0).outline).width, 0.02);
  EXPECT_EQ(std::get<RectangleMesh>(scene.particles.at(0).mesh).columns, 16);
  EXPECT_EQ(scene.bodies.at(0).position, Vec3(0.01, 0.005, 0));
  EXPECT_EQ(scene.tools.at(2).name, "pusher");
  EXPECT_EQ(scene.stages.at(1).moves.at(0).tool, 2);
  EXPECT_EQ(scene.stages.at(1).moves.at(0).displacement, Vec3(1e-4, 0, 0));
  EXPECT_EQ(scene.stages.at(1).kind, StageSpec::Kind::compact);
  EXPECT_EQ(scene.frictions.at(0).first, "steel");
  EXPECT_EQ(scene.frictions.at(0).second, "floor");
  EXPECT_EQ(scene.materials.at(0).mark.line, 10);
  EXPECT_EQ(scene.materials.at(0).mark.column, 1);
}

TEST(Read, NormalsAreNormalised) {
  const auto normal = [](const std::string& value) {
    return load_scene_text(std::string(smallest) +
                               "[[tool]]\nname = \"a\"\nshape = \"plane\"\n"
                               "point = [\"0 m\", \"0 m\"]\nnormal = " +
                               value,
                           "n.toml")
        .scene.tools.at(0)
        .normal;
  };
  EXPECT_TRUE(normal("[3, 4]").isApprox(Vec3(0.6, 0.8, 0), 1e-15));
  EXPECT_EQ(normal("[0, -7.5]"), Vec3(0, -1, 0));
  EXPECT_NEAR(normal("[1e200, 1e200]").norm(), 1, 1e-15);
}

TEST(Read, MeshPhaseIsAnAngleOrRandom) {
  const auto particle = [](const std::string& phase) {
    return load_scene_text(smallest, "p.toml", {"particle.disc.mesh.phase=" + phase})
        .scene.particles.at(0);
  };
  EXPECT_TRUE(particle("random").random_mesh_phase);
  EXPECT_FALSE(particle("45 deg").random_mesh_phase);
  EXPECT_DOUBLE_EQ(particle("45 deg").mesh_phase, std::numbers::pi / 4);
}

// A scene of one disc; `top` before, `mesh` in its mesh table.
Scene disc_scene(const std::string& top, const std::string& mesh) {
  return load_scene_text(top +
                             "\nfamily = \"compaction\"\n[[material]]\nname = \"m\"\ndensity = "
                             "\"1 kg/m^3\"\nyoungs_modulus = \"1 GPa\"\npoissons_ratio = 0.3\n"
                             "[[particle]]\nname = \"p\"\nmaterial = \"m\"\noutline = \"disc\"\n"
                             "diameter = \"1 mm\"\n" +
                             (mesh.empty() ? "" : "[particle.mesh]\n" + mesh) +
                             "\n[[body]]\nparticle = \"p\"\nposition = [\"0 m\", \"0 m\"]\n"
                             "[[stage]]\nname = \"s\"\nkind = \"settle\"\nduration = \"1 s\"\n",
                         "disc.toml")
      .scene;
}
int edges_of(const Scene& scene) {
  return std::get<DiscMesh>(scene.particles[0].mesh).boundary_edges;
}

TEST(Read, AccuracyMakesMeshesThatAreNotGiven) {
  const int draft = edges_of(disc_scene("accuracy = \"draft\"", ""));
  const int standard = edges_of(disc_scene("", ""));
  const int fine = edges_of(disc_scene("accuracy = \"fine\"", "phase = \"1 deg\""));
  EXPECT_LT(draft, standard);
  EXPECT_LT(standard, fine);
  EXPECT_EQ(edges_of(disc_scene("accuracy = \"standard\"", "")), standard);
  EXPECT_EQ(edges_of(disc_scene("", "rings = 2")), DiscMesh{}.boundary_edges);
}

TEST(Read, AccuracyWithoutEffectIsRefused) {
  const std::string what =
      message_of([] { disc_scene("accuracy = \"fine\"", "boundary_edges = 24"); });
  EXPECT_NE(what.find("accuracy: has no effect"), std::string::npos) << what;
}

TEST(Read, OverridesByKeyNameAndPosition) {
  const Scene scene = read_scene(
      folder / "compaction" / "regular-25.toml",
      {"title=softer", "time.safety=0.5", "material.316L.yield_stress=100 MPa",
       "material[0].density = \"8 g/cm^3\"", "tool.top.point=[\"0 m\", \"51 mm\"]",
       "stage.press.move.top.ramp=0.25", "stage[0].duration=2 ms", "limits.kinetic_energy=0.01",
       "particle.disc.mesh.rings=2", "output.frames=7", "packing[0].rows=4"});
  EXPECT_EQ(scene.title, "softer");
  EXPECT_EQ(scene.time.safety, 0.5);
  EXPECT_EQ(scene.materials.at(0).yield_stress, 100e6);
  EXPECT_EQ(scene.materials.at(0).density, 8000);
  EXPECT_EQ(scene.tools.at(3).point, Vec3(0, 0.051, 0));
  EXPECT_EQ(scene.stages.at(0).moves.at(0).ramp, 0.25);
  EXPECT_EQ(scene.stages.at(0).duration, 0.002);
  EXPECT_EQ(scene.limits.kinetic_energy, 0.01);
  EXPECT_EQ(std::get<DiscMesh>(scene.particles.at(0).mesh).rings, 2);
  EXPECT_EQ(scene.output.frames, 7);
  EXPECT_EQ(scene.packings.at(0).cells[1], 4);
}

TEST(Read, TheLaterOverrideWins) {
  EXPECT_EQ(load_scene_text(smallest, "s.toml", {"seed=2", "seed=3"}).scene.seed, 3U);
}

TEST(Read, ANameWithADotIsQuotedInAnOverride) {
  std::string text = smallest;
  text.replace(text.find("\"rest\""), 6, "\"v1.0\"");
  const Scene scene = load_scene_text(text, "s.toml", {"stage.\"v1.0\".duration=3 s"}).scene;
  EXPECT_EQ(scene.stages.at(0).duration, 3);
}

TEST(Read, AByteOrderMarkAndWindowsLineEndsAreAccepted) {
  std::string text = "\xEF\xBB\xBF";
  for (const char* c = smallest; *c != '\0'; ++c) text += *c == '\n' ? "\r\n" : std::string(1, *c);
  EXPECT_EQ(load_scene_text(text, "s.toml").hash, load_scene_text(smallest, "s.toml").hash);
}

TEST(Read, TitlesKeepTheirCharacters) {
  const auto loaded = load_scene_text(smallest, "s.toml", {"title=σ/σ_y \"at\" 5 µm\\"});
  EXPECT_EQ(loaded.scene.title, "σ/σ_y \"at\" 5 µm\\");
  EXPECT_EQ(load_scene_text(loaded.text, "again.toml").scene.title, loaded.scene.title);
}

TEST(SceneText, EveryShippedSceneReadsAndItsSavedOneSaysTheSame) {
  EXPECT_GE(shipped_scenes().size(), 13U);
  const std::filesystem::path saved =
      std::filesystem::temp_directory_path() / ("pulvis-saved-" + std::to_string(getpid()));
  std::filesystem::create_directory(saved);
  for (const auto& file : shipped_scenes()) {
    SCOPED_TRACE(file);
    const LoadedScene first = load_scene(file);
    save_scene(saved, first);
    const LoadedScene again = load_scene(saved / "scene.toml");
    EXPECT_EQ(again.text, first.text);
    EXPECT_EQ(again.hash, first.hash);
    EXPECT_EQ(again.scene.stages.size(), first.scene.stages.size());
    EXPECT_FALSE(first.scene.title.empty());
  }
  std::filesystem::remove_all(saved);
}

// Who looks a number up goes through three files at most, and no part lies about unused.
TEST(SceneText, ShippedScenesExtendFewFiles) {
  namespace fs = std::filesystem;
  std::set<fs::path> extended;
  for (const auto& file : shipped_scenes()) {
    const Scene scene = read_scene(file);
    EXPECT_LE(scene.extended.size(), 2U) << file;
    for (const fs::path& other : scene.extended) extended.insert(fs::canonical(other));
  }
  for (const auto& part : fs::directory_iterator(paths::source_dir() + "/scenes/parts"))
    EXPECT_TRUE(extended.contains(fs::canonical(part.path()))) << part.path();
}

TEST(SceneText, HoldsOverridesAndDefaults) {
  const std::string text = load_scene_text(smallest, "s.toml", {"time.safety=0.5"}).text;
  EXPECT_THAT(text, HasSubstr("safety = 0.5"));
  EXPECT_THAT(text, HasSubstr("thickness = \"1 mm\""));
  EXPECT_THAT(text, HasSubstr("boundary_edges = 72\nrings = 1\ncore = \"coarse\""));
  EXPECT_THAT(text, testing::Not(HasSubstr("hardening_modulus")));
}

TEST(SceneHash, DependsOnWhatIsSaidNotOnHow) {
  const LoadedScene plain = load_scene_text(smallest, "a.toml");
  std::string other = "# a comment\nthickness = \"1 mm\"\n" + std::string(smallest);
  EXPECT_EQ(load_scene_text(other, "b.toml").hash, plain.hash);
  EXPECT_NE(load_scene_text(smallest, "a.toml", {"seed=2"}).hash, plain.hash);
  EXPECT_NE(load_scene_text(smallest, "a.toml", {"title=x"}).hash, plain.hash);
}

// As `xxhsum -H3` says.
TEST(SceneHash, IsXxh3) {
  EXPECT_EQ(scene_hash(""), 0x2d06800538d394c2U);
  EXPECT_EQ(scene_hash("a"), 0xe6c632b61e964e1fU);
  EXPECT_EQ(scene_hash("abc"), 0x78af5f94892f3950U);
}

}  // namespace
}  // namespace pulvis
