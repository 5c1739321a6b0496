// What a periodic cell cannot do is refused at its key, with the reason and what is allowed.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "scenes/build.hpp"
#include "tests/helpers/right_scene.hpp"

namespace pulvis {
namespace {

using testing::HasSubstr;

std::string scene(const std::string& cell, const std::string& packing, const std::string& drive,
                  const std::string& more = "") {
  return fmt::format(R"(family = "compaction"
[[material]]
name = "Cu"
density = "8940 kg/m^3"
youngs_modulus = "115 GPa"
poissons_ratio = 0.35
[[particle]]
name = "disc"
material = "Cu"
outline = "disc"
diameter = "1 mm"
{}
{}
[[stage]]
name = "press"
kind = "compact"
duration = "0.1 ms"
[stage.cell]
{}
{})",
                     cell, packing, drive, more);
}

constexpr const char* cell = "[cell]\nwidth = \"4 mm\"\n";
constexpr const char* tall = "[cell]\nwidth = \"4 mm\"\nheight = \"4 mm\"\n";
constexpr const char* random_packing =
    "[[packing]]\nkind = \"random\"\nwidth = \"4 mm\"\ndensity = 0.6\nclass = [{ particle = "
    "\"disc\", "
    "number = 9 }]\n";
constexpr const char* body = "[[body]]\nparticle = \"disc\"\nposition = [\"2 mm\", \"2 mm\"]\n";

std::string damped(std::string text) {
  const std::string last = "poissons_ratio = 0.35\n";
  return text.insert(text.find(last) + last.size(),
                     "[material.damping]\nmass_proportional = \"1 1/s\"\n");
}

struct WrongCell {
  const char* name;
  std::string text;
  const char* key;
  const char* says;
};
void PrintTo(const WrongCell& wrong, std::ostream* out) { *out << wrong.name; }

class WrongCells : public testing::TestWithParam<WrongCell> {};

TEST_P(WrongCells, AreRefused) {
  const std::vector<SceneProblem> problems = problems_of(GetParam().text);
  ASSERT_FALSE(problems.empty());
  EXPECT_EQ(problems.front().key, GetParam().key) << problems.front().text();
  EXPECT_THAT(problems.front().text(), HasSubstr(GetParam().says));
  EXPECT_THAT(problems.front().text(), HasSubstr("allowed: "));
}

INSTANTIATE_TEST_SUITE_P(
    Of, WrongCells,
    testing::Values(
        WrongCell{"none", scene("", body, "strain_yy = -0.1"), "stage[0].cell", "there is no cell"},
        WrongCell{"ratio_and_strain",
                  scene(cell, random_packing, "stress_ratio = 0.5\nstrain_xx = -0.1"),
                  "stage[0].cell.stress_ratio", "one of strain_xx"},
        WrongCell{"ratio_and_mean",
                  scene(cell, random_packing, "stress_ratio = 0.5\nmean_stress = \"-1 MPa\""),
                  "stage[0].cell.mean_stress", "one of strain_xx"},
        WrongCell{"until_force",
                  scene(cell, random_packing, "strain_yy = -0.1",
                        "[stage.until]\nrelative_density = 0.9\nforce = \"1 N\""),
                  "stage[0].until.force", "tool"},
        WrongCell{"damped_by_its_mass", damped(scene(cell, random_packing, "strain_yy = -0.1")),
                  "material[0].damping.mass_proportional", "relative to a fixed frame"},
        WrongCell{"no_height", scene(cell, body, "strain_yy = -0.1"), "cell", "height is missing"},
        WrongCell{"height_twice", scene(tall, random_packing, "strain_yy = -0.1"), "cell.height",
                  "it follows from the random packing"},
        WrongCell{"other_width",
                  scene("[cell]\nwidth = \"5 mm\"\n", random_packing, "strain_yy = -0.1"),
                  "packing[0].width", "0.005 m"},
        WrongCell{"both", scene(tall, body, "strain_yy = -0.1\nstress_yy = \"-1 MPa\""),
                  "stage[0].cell.stress_yy", "has a strain as well"},
        WrongCell{"tool",
                  scene(tall, body, "strain_yy = -0.1",
                        "[[tool]]\nname = \"floor\"\nshape = \"plane\"\npoint = [\"0 mm\", \"0 "
                        "mm\"]\nnormal = [0, 1]\n"),
                  "tool[0]", "has no walls"},
        WrongCell{"rise_of_strains", scene(tall, body, "strain_yy = -0.1\nrise = 0.5"),
                  "stage[0].cell.rise", "no effect without a stress"},
        WrongCell{"tolerance_of_strains", scene(tall, body, "strain_yy = -0.1\ntolerance = 1"),
                  "stage[0].cell.tolerance", "no effect without a stress"},
        WrongCell{"response_of_strains", scene(tall, body, "rotation = \"1 deg\"\nresponse = 1"),
                  "stage[0].cell.response", "no effect without a stress"},
        WrongCell{"ramp_of_stresses", scene(tall, body, "stress_yy = \"-1 MPa\"\nramp = 0.2"),
                  "stage[0].cell.ramp", "no effect without a strain"},
        WrongCell{"empty", scene(tall, body, "strain_zz = -0.1"), "stage[0].cell.strain_zz",
                  "three dimensions only"}),
    [](const auto& wrong) { return std::string(wrong.param.name); });

// ---- in three dimensions --------------------------------------------------------------------------------
std::string space_scene(const std::string& cell, const std::string& powder,
                        const std::string& drive, const std::string& more = "") {
  std::string text = scene(cell, powder, drive, more);
  const auto replace = [&](const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
  };
  replace("family = \"compaction\"\n", "family = \"compaction\"\ndimension = 3\n");
  replace("outline = \"disc\"", "shape = \"sphere\"");
  return text;
}

constexpr const char* flat = "[cell]\nwidth = \"4 mm\"\nheight = \"4 mm\"\n";
constexpr const char* deep = "[cell]\nwidth = \"4 mm\"\ndepth = \"4 mm\"\nheight = \"4 mm\"\n";
constexpr const char* open = "[cell]\nwidth = \"4 mm\"\ndepth = \"4 mm\"\n";
constexpr const char* ball =
    "[[body]]\nparticle = \"disc\"\nposition = [\"2 mm\", \"2 mm\", \"2 mm\"]\n";

std::string random_balls(const char* depth) {
  return fmt::format(
      "[[packing]]\nkind = \"random\"\nwidth = \"4 mm\"\n{}\ndensity = 0.5\nclass = [{{ particle = "
      "\"disc\", number = 9 }}]\n",
      depth);
}

INSTANTIATE_TEST_SUITE_P(
    InThreeDimensions, WrongCells,
    testing::Values(
        WrongCell{"no_depth", space_scene(flat, ball, "strain_zz = -0.1"), "cell.depth", "missing"},
        WrongCell{"no_height", space_scene(open, ball, "strain_zz = -0.1"), "cell",
                  "height is missing"},
        WrongCell{"angle",
                  space_scene(std::string(deep) + "angle = \"10 deg\"\n", ball, "strain_zz = -0.1"),
                  "cell.angle", "two dimensions only"},
        WrongCell{"height_twice",
                  space_scene(deep, random_balls("depth = \"4 mm\""), "strain_zz = -0.1"),
                  "cell.height", "it follows from the random packing"},
        WrongCell{"other_depth",
                  space_scene(open, random_balls("depth = \"5 mm\""), "strain_zz = -0.1"),
                  "packing[0].depth", "0.004 m"},
        WrongCell{"both", space_scene(deep, ball, "strain_zx = 0.1\nstress_zx = \"1 MPa\""),
                  "stage[0].cell.stress_zx", "has a strain as well"},
        WrongCell{"other_name", space_scene(deep, ball, "strain_xz = 0.1"),
                  "stage[0].cell.strain_xz", "strain_zx"},
        WrongCell{"ratio_and_depth",
                  space_scene(deep, ball, "stress_ratio = 0.5\nstress_yy = \"-1 MPa\""),
                  "stage[0].cell.stress_ratio", "yy is prescribed twice"},
        WrongCell{"scalar_rotation", space_scene(deep, ball, "rotation = \"1 deg\""),
                  "stage[0].cell.rotation", "allowed: "},
        WrongCell{
            "constraint",
            space_scene(deep, ball, "strain_zz = -0.1",
                        "[[tool]]\nname = \"held\"\nshape = \"constraint\"\nholds = \"all\"\n"
                        "low = [\"0 mm\", \"0 mm\", \"0 mm\"]\nhigh = [\"4 mm\", \"4 mm\", \"4 "
                        "mm\"]\n"),
            "tool[0]", "has no walls"},
        WrongCell{
            "densities",
            space_scene(deep, ball, "strain_zz = -0.1", "[output]\ndensity_cells = [2, 2, 2]\n"),
            "output.density_cells", "do not enclose"},
        WrongCell{"until_force",
                  space_scene(deep, ball, "strain_zz = -0.1", "[stage.until]\nforce = \"1 N\""),
                  "stage[0].until.force", "tool"}),
    [](const auto& wrong) { return std::string(wrong.param.name); });

TEST(RightCell, HasTheHeightOfItsPacking) {
  const Scene right =
      load_scene_text(scene(cell, random_packing, "strain_yy = -0.1"), "cell.toml").scene;
  ASSERT_TRUE(right.cell->height);
  EXPECT_NEAR(9 * 0.25 * 3.14159265e-6 / (4e-3 * *right.cell->height), 0.6, 1e-6);
}

// A particle that only its image runs into.
TEST(WrongPlaces, AreFoundAcrossTheBorder) {
  const std::string text = scene(tall,
                                 std::string(body) +
                                     "[[body]]\nparticle = \"disc\"\nposition = [\"0.3 mm\", "
                                     "\"2 mm\"]\n[[body]]\nparticle = \"disc\"\nposition = "
                                     "[\"3.8 mm\", \"2 mm\"]\n",
                                 "strain_yy = -0.1");
  EXPECT_THAT(message_of([&] { build_world(load_scene_text(text, "cell.toml").scene); }),
              HasSubstr("the image of particle"));
}

}  // namespace
}  // namespace pulvis
