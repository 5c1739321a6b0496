// Packings in files in three dimensions: what is written is read back bit for bit; what is wrong is refused at its place.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "scenes/packing/packing_file.hpp"
#include "tests/scenes/packing/solids/packed_scene.hpp"

namespace pulvis::space {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const std::vector<ParticleShape> two_shapes{SphereShape{10e-3}, CylinderShape{12e-3, 6e-3, 1e-3}};

// In a folder of its own.
Scene from_file(const std::string& name, const std::string& text) {
  const fs::path folder = fs::temp_directory_path() / "pulvis_packing_in_space";
  fs::create_directories(folder);
  std::ofstream(folder / name, std::ios::binary) << text;
  PackingSpec packing;
  packing.kind = PackingSpec::Kind::csv;
  packing.file = name;
  Scene scene = scene_of(two_shapes, packing);
  scene.file = folder / "scene.toml";
  return scene;
}

std::string refusal_of(const std::string& text) {
  Scene scene = from_file("wrong.csv", text);
  try {
    filled(scene);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

TEST(PackingFileInSpace, IsReadBackBitForBit) {
  PackingSpec packing = in_cylinder(50e-3, {20, 20});
  packing.density = 0.45;
  SizeLaw& law = packing.classes[1].size;
  law.kind = SizeLaw::Kind::uniform;
  law.minimum = 9e-3;
  law.maximum = 14e-3;
  Scene scene = scene_of(two_shapes, packing);
  const PackingSpec made = filled(scene);
  const std::string text = packing_text(scene, place_bodies(scene));
  EXPECT_THAT(text, HasSubstr("# Packing of packed.toml, seed 1\n"));
  EXPECT_THAT(text, HasSubstr("relative density 0.450000"));
  EXPECT_THAT(text, HasSubstr("class,x [m],y [m],z [m],qw,qx,qy,qz,scale\n"));
  Scene again = from_file("packing.csv", text);
  const PackingSpec read = filled(again);
  EXPECT_EQ(read.top, made.top);
  ASSERT_EQ(read.placed.size(), made.placed.size());
  for (std::size_t i = 0; i < read.placed.size(); ++i) {
    const BodySpec &a = made.placed[i], &b = read.placed[i];
    EXPECT_EQ(a.position, b.position);
    EXPECT_EQ(a.rotation.coeffs(), b.rotation.coeffs());
    const ParticleSpec& own = scene.particles[static_cast<std::size_t>(a.particle)];
    const ParticleSpec& other = again.particles[static_cast<std::size_t>(b.particle)];
    EXPECT_EQ(own.scale, other.scale);
    EXPECT_EQ(own.class_of, other.class_of);
  }
  const std::string again_text = packing_text(again, place_bodies(again));
  EXPECT_EQ(again_text.substr(again_text.find("class,")), text.substr(text.find("class,")));
}

TEST(PackingFileInSpace, UnitsAreRead) {
  Scene scene = from_file(
      "units.csv", "class;x [mm];y [um];z [m];qw;qx;qy;qz\n# top: 30 mm\nb;1;2;0,003;0;2;0;0\n");
  const PackingSpec packing = filled(scene);
  ASSERT_EQ(packing.placed.size(), 1u);
  EXPECT_LT((packing.placed[0].position - Vec3(1e-3, 2e-6, 3e-3)).norm(), 1e-15);
  EXPECT_EQ(packing.placed[0].rotation.coeffs(), Rotation(0, 1, 0, 0).coeffs());  // of length 1
  EXPECT_DOUBLE_EQ(packing.top, 30e-3);
}

// Without a top a punch rests on the highest particle: a tablet on edge reaches half its diameter up.
TEST(PackingFileInSpace, WithoutATopThePunchRestsOnTheHighest) {
  Scene scene =
      from_file("high.csv",
                "class,x [m],y [m],z [m],qw,qx,qy,qz\n"
                "a,0,0,0.01,1,0,0,0\nb,0.1,0,0.02,0.70710678118654752,0.70710678118654752,0,0\n");
  EXPECT_NEAR(filled(scene).top, 26e-3, 1e-12);
}

TEST(PackingFileInSpace, WrongOnesAreRefused) {
  const std::string header = "class,x [m],y [m],z [m],qw,qx,qy,qz\n";
  EXPECT_THAT(refusal_of(header + "c,0,0,0,1,0,0,0\n"),
              HasSubstr("wrong.csv:2:1: class: no particle is called 'c', allowed: a, b"));
  EXPECT_THAT(refusal_of(header + "a,0,0,0,0,0,0,0\n"),
              HasSubstr("the quaternion is 0, allowed: a non-zero one"));
  EXPECT_THAT(refusal_of("class,x [m],y [m],qw,qx,qy,qz\na,0,0,1,0,0,0\n"), HasSubstr("z"));
  EXPECT_THAT(refusal_of("# top: 3 kg\n" + header + "a,0,0,0,1,0,0,0\n"),
              HasSubstr("allowed: # top: and a quantity in m"));
}

}  // namespace
}  // namespace pulvis::space
