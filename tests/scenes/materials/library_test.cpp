// Materials by name.
#include <gmock/gmock.h>

#include <fstream>
#include <sstream>

#include "scenes/materials/library.hpp"
#include "tests/helpers/paths.hpp"
#include "tests/helpers/right_scene.hpp"
#include "tests/helpers/wrong.hpp"

namespace pulvis {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr const char* values_of_316l = R"(density = "7990 kg/m^3"
youngs_modulus = "200 GPa"
poissons_ratio = 0.3
yield_stress = "240 MPa"
hardening_modulus = "440 MPa"
)";

std::string scene_of(const std::string& material) {
  std::string text = right_scene;
  const std::string values = values_of_316l;
  return text.replace(text.find(values), values.size(), material);
}

LoadedScene loaded_with(const std::string& material) {
  return load_scene_text(scene_of(material), "library.toml");
}

MaterialSpec material_of(const std::string& material) {
  return loaded_with(material).scene.materials[0];
}

std::string afm_with(const std::string& material) {
  return "family = \"afm\"\n[[material]]\nname = \"lever\"\n" + material + R"(
[lever]
shape = "beam"
material = "lever"
length = "440 um"
width = "50 um"
thickness = "2.2 um"
[tip]
shape = "block"
material = "lever"
height = "12.6 um"
foot = "2 um"
set_back = "1 um"
)";
}

class EveryLibraryMaterial : public testing::TestWithParam<LibraryMaterial> {};

TEST_P(EveryLibraryMaterial, HasValuesInRangeAndASource) {
  const LibraryMaterial& material = GetParam();
  const std::string line = "library = \"" + material.name + "\"\n";
  const MaterialSpec spec = material_of(line);
  EXPECT_GT(spec.density, 0);
  EXPECT_EQ(material.name.find(' '), std::string::npos);
  EXPECT_FALSE(material.title.empty());
  EXPECT_TRUE(material.source.ends_with("."));
  EXPECT_LT(spec.yield_stress.value_or(0), 0.1 * spec.youngs_modulus);
  EXPECT_EQ(loaded_with(line + "elastic = true\n").scene.materials[0].yield_stress, std::nullopt);
}

INSTANTIATE_TEST_SUITE_P(All, EveryLibraryMaterial, testing::ValuesIn(material_library()));

TEST(MaterialLibrary, IsTheSameAsItsValues) {
  const LoadedScene named = loaded_with("library = \"316L\"\n"),
                    given = loaded_with(values_of_316l);
  EXPECT_EQ(named.text, given.text);
  EXPECT_EQ(named.hash, given.hash);
}

TEST(MaterialLibrary, GivesWayToOwnValues) {
  const MaterialSpec spec = material_of("library = \"316L\"\nyield_stress = \"280 MPa\"\n");
  EXPECT_EQ(spec.yield_stress, 280e6);
  EXPECT_EQ(spec.youngs_modulus, 200e9);
  EXPECT_EQ(spec.hardening_modulus, 440e6);
}

TEST(MaterialLibrary, WithoutAnyValueToGiveIsRefused) {
  const std::string wrong =
      message_of([] { loaded_with(std::string(values_of_316l) + "library = \"316L\"\n"); });
  EXPECT_NE(wrong.find("material[0].library: has no effect: the material has all of these values"),
            std::string::npos)
      << wrong;
}

TEST(MaterialLibrary, GivesWayToAnotherLawOfHardening) {
  const LoadedScene loaded = loaded_with(
      "library = \"316L\"\nhardening = { law = \"voce\", saturation = \"300 MPa\", "
      "saturation_rate = 8.0 }\n");
  EXPECT_THAT(loaded.text, Not(HasSubstr("440 MPa")));
  EXPECT_THAT(loaded.text, HasSubstr("[material.hardening]"));
}

TEST(MaterialLibrary, LeavesOutWhatAFamilyDoesNotKnow) {
  const LoadedScene loaded = load_scene_text(afm_with("library = \"Si3N4\""), "afm.toml");
  EXPECT_EQ(loaded.scene.materials[0].youngs_modulus, 280e9);
  EXPECT_THAT(loaded.text, Not(HasSubstr("density")));
}

TEST(MaterialLibrary, IsChosenByOverridesToo) {
  const Scene scene =
      load_scene_text(scene_of("library = \"316L\"\n"), "x.toml", {"material.316L.library=Cu-OFHC"})
          .scene;
  EXPECT_EQ(scene.materials[0].yield_stress, 50e6);
}

std::string problem_of(const std::string& material) {
  const auto problems = problems_of(scene_of(material));
  return problems.empty() ? "" : problems[0].text();
}

TEST(MaterialLibrary, NamesWhatItHas) {
  EXPECT_THAT(problem_of("library = \"316l\"\n"),
              HasSubstr("wrong.toml:7:11: material[0].library: \"316l\" is not a material of the "
                        "library, did you mean '316L'?, allowed: 316L, Cu-OFHC, Fe"));
  EXPECT_THAT(problem_of("library = 316\n"), HasSubstr("316 is not a material of the library"));
  EXPECT_THAT(problem_of("library = \"316L\"\nelastic = 1\n"), HasSubstr("allowed: true or false"));
  EXPECT_THAT(problem_of("library = \"316L\"\nelastic = true\nyield_stress = \"1 MPa\"\n"),
              HasSubstr("contradicts elastic = true"));
  EXPECT_THAT(problem_of(std::string(values_of_316l) + "elastic = true\n"),
              HasSubstr("has no effect without library"));
}

TEST(MaterialLibrary, IsInTheDocuments) {
  std::ifstream file(paths::source_dir() + "/docs/materials.md");
  std::ostringstream text;
  text << file.rdbuf();
  EXPECT_EQ(text.str(), material_reference());
}

}  // namespace
}  // namespace pulvis
