// Scenes in three dimensions: what is read, and that what two dimensions alone have is refused with a sentence.
#include <gmock/gmock.h>

#include "scenes/keys/tables.hpp"
#include "scenes/packing/place.hpp"
#include "scenes/spec/scene.hpp"
#include "tests/helpers/elastic_ball.hpp"
#include "tests/helpers/paths.hpp"
#include "tests/helpers/right_scene.hpp"
#include "tests/helpers/right_space_scene.hpp"

#include <numbers>

namespace pulvis {
namespace {

using testing::HasSubstr;

LoadedScene loaded(const std::vector<std::string>& overrides = {}) {
  return load_scene_text(right_space_scene, "right.toml", overrides);
}

TEST(SpaceScene, HasWhatItsFileSays) {
  const Scene scene = loaded().scene;
  ASSERT_EQ(scene.dimension, 3);
  const Scene& in_space = scene;
  ASSERT_EQ(in_space.particles.size(), 2U);
  EXPECT_EQ(std::get<SphereShape>(in_space.particles[0].shape).diameter, 10e-3);
  EXPECT_EQ(in_space.particles[0].hex_mesh.divisions, 2);
  EXPECT_EQ(std::get<CylinderShape>(in_space.particles[1].shape).rounding, 1e-3);
  ASSERT_EQ(in_space.tools.size(), 2U);
  EXPECT_EQ(in_space.tools[1].normal, Vec3(0, 0, -1));
  EXPECT_EQ(in_space.tools[1].point, Vec3(0, 0, 20e-3));
  ASSERT_EQ(scene.stages.size(), 1U);
  EXPECT_EQ(scene.stages[0].moves.at(0).displacement, Vec3(0, 0, -1e-3));
  EXPECT_EQ(scene.frictions[0].coefficient, 0.3);
  EXPECT_EQ(place_bodies(scene).size(), 5U);
}

// A turn of 30 degrees about z takes the x axis to (cos 30, sin 30, 0).
TEST(SpaceScene, TurnsBodiesAboutTheirAxis) {
  const Vec3 turned = loaded().scene.bodies[0].rotation * Vec3::UnitX();
  EXPECT_NEAR(turned.x(), std::numbers::sqrt3 / 2, 1e-15);
  EXPECT_NEAR(turned.y(), 0.5, 1e-15);
  const auto about_x = loaded({"body[0].axis=[2, 0, 0]"}).scene.bodies[0].rotation;
  EXPECT_NEAR((about_x * Vec3::UnitY()).z(), 0.5, 1e-15);
}

TEST(SpaceScene, ContactsIndentWhereAMaterialYields) {
  std::string elastic = elastic_ball("divisions = 4", "damping = 0.3", "1 mm");
  const auto stiffness = [&](const std::vector<std::string>& overrides) {
    const LoadedScene given = load_scene_text(elastic, "elastic.toml", overrides);
    EXPECT_EQ(load_scene_text(given.text, "elastic.toml").text, given.text);
    return given.scene.contact.stiffness;
  };
  const auto hardness = [&](const std::vector<std::string>& overrides) {
    return load_scene_text(elastic, "elastic.toml", overrides).scene.contact.hardness;
  };
  EXPECT_EQ(stiffness({}), 20);
  EXPECT_EQ(stiffness({"contact.friction=0.2"}), 20);
  EXPECT_EQ(stiffness({"contact.stiffness=2"}), 2);
  EXPECT_EQ(hardness({}), std::nullopt);
  EXPECT_EQ(hardness({"material.steel.yield_stress=300 MPa"}), 3);
  EXPECT_EQ(hardness({"material.steel.yield_stress=300 MPa", "contact.stiffness=2"}), std::nullopt);
  EXPECT_EQ(hardness({"material.steel.yield_stress=300 MPa", "contact.hardness=4"}), 4);
  const std::string table = paths::source_dir() + "/scenes/basic/flow-laws.csv";
  EXPECT_EQ(load_scene_text(
                elastic, "elastic.toml",
                {"material.steel.hardening.law=table", "material.steel.hardening.file=" + table})
                .scene.contact.hardness,
            3);
  elastic = "family = \"compaction\"\ndimension = 3\ncontact = 3\n";
  EXPECT_ANY_THROW(stiffness({}));
}

TEST(SpaceScene, SavedItIsTheSame) {
  const LoadedScene given = loaded();
  const LoadedScene again = load_scene_text(given.text, "right.toml");
  EXPECT_THAT(given.text, HasSubstr("dimension = 3\n"));
  EXPECT_EQ(again.text, given.text);
  EXPECT_EQ(again.hash, given.hash);
}

TEST(SpaceScene, AccuracyStandsForMeshes) {
  const auto mesh = [](const std::string& accuracy) {
    std::string text = right_space_scene;
    const std::string counts = "divisions = 3\nrings = 3\n";
    text.erase(text.find(counts), counts.size());
    return load_scene_text(text, "right.toml", {"accuracy=" + accuracy})
        .scene.particles[1]
        .hex_mesh;
  };
  EXPECT_LT(mesh("draft").divisions, mesh("standard").divisions);
  EXPECT_LT(mesh("standard").divisions, mesh("fine").divisions);
  EXPECT_EQ(mesh("standard").divisions, 7);
  EXPECT_EQ(mesh("standard").rings, 1);
}

TEST(SpaceScene, SpheresOfALatticeTouchWithoutASpacing) {
  const auto spacing = [](const char* kind) {
    return loaded({std::string("packing[0].kind=") + kind}).scene.packings[0].spacing;
  };
  EXPECT_DOUBLE_EQ(spacing("cubic"), 10e-3);
  EXPECT_DOUBLE_EQ(spacing("body-centred"), 20e-3 / std::numbers::sqrt3);
  EXPECT_DOUBLE_EQ(spacing("face-centred"), 10e-3 * std::numbers::sqrt2);
}

TEST(SpaceScene, TwoDimensionsNeedNotBeSaidAndChangeNothing) {
  const LoadedScene unsaid = load_scene_text(right_scene, "right.toml");
  const LoadedScene said = load_scene_text(right_scene, "right.toml", {"dimension=2"});
  EXPECT_EQ(said.text, unsaid.text);
  EXPECT_EQ(said.hash, unsaid.hash);
  EXPECT_EQ(said.scene.dimension, 2);
}

TEST(SpaceScene, VariablesStandForComponents) {
  const Scene scene = loaded({"let.h=20 mm", "tool.top.point=[\"0 mm\", \"0 mm\", \"h\"]"}).scene;
  EXPECT_EQ(scene.tools[1].point.z(), 20e-3);
}

// Extending and copying files, and sorting the tables of a scene, do not depend on its dimension.
TEST(SceneLanguage, NamesFilesAndElementsAlikeInBothDimensions) {
  for (const schema::TableView& view : schema::scene_language(3)) {
    const schema::TableView* plane = schema::find_table(view.info.path, schema::scene_language(2));
    ASSERT_NE(plane, nullptr) << view.info.path;
    for (const schema::KeyInfo& key : view.keys) {
      const schema::KeyInfo* same = schema::find_key(*plane, key.name);
      const auto is_path = [](const schema::KeyInfo& k) {
        return k.kind == schema::Kind::file || k.kind == schema::Kind::scene;
      };
      if (same == nullptr) continue;
      EXPECT_EQ(is_path(*same), is_path(key)) << view.info.path << "." << key.name;
    }
  }
}

// Values are passed to the setter that was declared with their key, whatever was left out before it.
TEST(SceneLanguage, HasWholeVectorsAndNoWordsOfTheOtherDimension) {
  for (const int dimension : {2, 3})
    for (const schema::TableView& view : schema::scene_language(dimension))
      for (const schema::KeyInfo& key : view.keys) {
        const std::string name = view.info.path + "." + key.name;
        if (key.kind == schema::Kind::vector || key.kind == schema::Kind::direction) {
          EXPECT_EQ(key.components, dimension) << name;
        }
        for (const schema::Choice& choice : key.choices)
          EXPECT_FALSE(choice.dimension ==
                       (dimension == 2 ? schema::Dimension::three : schema::Dimension::two))
              << name << " = " << choice.word;
      }
  EXPECT_EQ(loaded({"element.formulation=eight-point"}).scene.element.formulation,
            Formulation::four_point);
}

}  // namespace
}  // namespace pulvis
