// [die]: the width is given once; packings and tools follow.
#include <gmock/gmock.h>

#include "scenes/packing/place.hpp"
#include "tests/helpers/right_scene.hpp"

namespace pulvis {
namespace {

using testing::HasSubstr;
using testing::Not;

const std::string powder = R"(family = "compaction"
[[material]]
name = "steel"
library = "steel"
[[particle]]
name = "disc"
material = "steel"
outline = "disc"
diameter = "2 mm"
[[stage]]
name = "press"
kind = "compact"
duration = "1 ms"
[[stage.move]]
tool = "top"
displacement = ["0 mm", "-0.1 mm"]
)";
const std::string lattice =
    "[[packing]]\nkind = \"square\"\nparticle = \"disc\"\nrows = 2\ncolumns = 3\n";
const std::string random_bed =
    "[[packing]]\nkind = \"random\"\ndensity = 0.6\nclass = [{ particle = \"disc\", number = 9 "
    "}]\n";

Scene scene_with(const std::string& text) {
  return load_scene_text(powder + text, "die.toml").scene;
}

std::string problem_with(const std::string& text) {
  const auto problems = problems_of(powder + text);
  return problems.empty() ? "" : problems[0].text();
}

std::vector<std::string> names_of(const Scene& scene) {
  std::vector<std::string> names;
  for (const ToolSpec& tool : scene.tools) names.push_back(tool.name);
  return names;
}

TEST(Die, StandsAroundALattice) {
  const Scene scene = scene_with(lattice + "corner = [\"1 mm\", \"2 mm\"]\n[die]\n");
  EXPECT_THAT(names_of(scene), testing::ElementsAre("left", "right", "bottom", "top"));
  EXPECT_DOUBLE_EQ(scene.tools[0].point.x(), 0.001);
  EXPECT_DOUBLE_EQ(scene.tools[1].point.x(), 0.007);
  EXPECT_DOUBLE_EQ(scene.tools[2].point.y(), 0.002);
  EXPECT_DOUBLE_EQ(scene.tools[3].point.y(), 0.006);
  EXPECT_EQ(scene.tools[1].normal, Vec3(-1, 0, 0));
}

// As by --set tool.left.rounding=0.4, before there are tools.
TEST(Die, RefusesChangesOfItsTools) {
  EXPECT_THAT(problem_with(lattice + "[die]\n[tool.left]\nrounding = 0.4\n"),
              HasSubstr("tool: the walls and punches of [die] cannot be set one by one"));
}

TEST(Die, GivesRandomPackingsItsWidthAndCorner) {
  const Scene scene =
      scene_with("[die]\nwidth = \"8 mm\"\ncorner = [\"1 mm\", \"0 mm\"]\n" + random_bed);
  EXPECT_DOUBLE_EQ(scene.packings[0].container.width, 0.008);
  EXPECT_DOUBLE_EQ(scene.packings[0].container.corner.x(), 0.001);
  EXPECT_DOUBLE_EQ(scene.tools[1].point.x(), 0.009);
  EXPECT_GT(scene.tools[3].point.y(), 9 * 3.14159e-6 / 0.008);
}

TEST(Die, LeavesToolsOfTheSceneAlone) {
  const std::string tools =
      "[[tool]]\nname = \"top\"\nshape = \"plane\"\npoint = [\"0 mm\", \"5 mm\"]\nnormal = [0, "
      "-1]\n[[tool]]\nname = \"right\"\nshape = \"plane\"\npoint = [\"6 mm\", \"9 mm\"]\nnormal = "
      "[-1, 0]\n";
  const Scene scene = scene_with(lattice + "[die]\n" + tools);
  EXPECT_THAT(names_of(scene), testing::ElementsAre("top", "right", "left", "bottom"));
  EXPECT_DOUBLE_EQ(scene.tools[0].point.y(), 0.005);
}

TEST(Die, IsNotInTheSavedScene) {
  const LoadedScene loaded = load_scene_text(powder + lattice + "[die]\n", "die.toml");
  EXPECT_THAT(loaded.text, Not(HasSubstr("[die]")));
  const LoadedScene again = load_scene_text(loaded.text, "die.toml");
  EXPECT_EQ(again.hash, loaded.hash);
}

TEST(Die, FollowsOverridesAndVariables) {
  const std::string text = powder + "[let]\nW = \"8 mm\"\n[die]\nwidth = \"W\"\n" + random_bed;
  const Scene scene = load_scene_text(text, "die.toml", {"let.W=10 mm"}).scene;
  EXPECT_DOUBLE_EQ(scene.packings[0].container.width, 0.01);
  EXPECT_DOUBLE_EQ(scene.tools[1].point.x(), 0.01);
}

TEST(WrongDie, IsNotBlamedForWhatItsWidthComesFrom) {
  const auto problems = problems_of(powder + lattice + "[die]\n", {"particle.disc.diameter=400"});
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].key, "particle[0].diameter");
  EXPECT_THAT(problems[0].message, HasSubstr("missing unit"));
}

// The width that the die lacks only follows from them.
TEST(WrongDie, IsNotBlamedForMistakesElsewhere) {
  const auto refusals = [](const std::string& from, const std::string& to) {
    std::string text = powder + lattice + "[die]\n";
    const auto at = text.find(from);
    if (at == std::string::npos) throw std::logic_error(from);
    std::string all;
    for (const SceneProblem& problem : problems_of(text.replace(at, from.size(), to)))
      all += problem.key + ": " + problem.message + "\n";
    return all;
  };
  const auto only = [](const std::string& start) {
    return testing::AllOf(testing::StartsWith(start), Not(HasSubstr("die.width")));
  };
  EXPECT_THAT(refusals("particle = \"disc\"", "particle = \"dics\""),
              only("packing[0].particle: no particle is called \"dics\", did you mean 'disc'?"));
  EXPECT_THAT(refusals("[[particle]]", "[[partcle]]"),
              HasSubstr("partcle: unknown table, did you mean 'particle'?"));
  EXPECT_THAT(refusals("[[packing]]", "[packing]"),
              only("packing: wrong type, a table is given, allowed: [[packing]]"));
  EXPECT_THAT(refusals("[[packing]]", "[[particle.packing]]"),
              only("particle[0].packing: unknown table: 'packing' belongs to the top level, as "
                   "[[packing]]"));
  EXPECT_THAT(refusals("columns", "colums"),
              HasSubstr("packing[0].colums: unknown key, did you mean 'columns'?"));
  EXPECT_THAT(refusals("diameter", "radius"), HasSubstr("particle[0].radius: "));
  EXPECT_THAT(refusals(lattice, ""),
              HasSubstr("die.width: required key is missing, allowed: a quantity in m; there is no "
                        "[[packing]] that it could follow from"));
}

TEST(WrongDie, IsRefusedAtItsPlace) {
  EXPECT_THAT(problem_with("[die]\nwidth = \"8 mm\"\n" + random_bed + "width = \"9 mm\"\n"),
              HasSubstr("packing[0].width: is 0.009 m, but that of the die is 0.008 m"));
  EXPECT_THAT(problem_with("[die]\n" + random_bed),
              HasSubstr("die.width: required key is missing"));
  EXPECT_THAT(problem_with(random_bed),
              HasSubstr("packing[0].width: required key is missing, allowed: a quantity in m"));
  EXPECT_THAT(
      problem_with(lattice + "[die]\n[[tool]]\nname = \"right\"\nshape = \"plane\"\npoint = [\"7 "
                             "mm\", \"9 mm\"]\nnormal = [-1, 0]\n"),
      HasSubstr("tool[0].point: is at x = 0.007 m, but this side of the die is at 0.006 m"));
  EXPECT_THAT(problem_with(lattice + "[die]\nwdth = \"1 mm\"\n"),
              HasSubstr("die.wdth: unknown key, did you mean 'width'?"));
  EXPECT_THAT(problem_with(lattice + "[die]\nwidth = 3\n"), HasSubstr("die.width: missing unit"));
}

// ---- in three dimensions ----------------------------------------------------------------------------
const std::string powder_in_space = R"(family = "compaction"
dimension = 3
[[material]]
name = "steel"
library = "steel"
[[particle]]
name = "ball"
material = "steel"
shape = "sphere"
diameter = "2 mm"
[particle.mesh]
divisions = 2
rings = 1
[[stage]]
name = "press"
kind = "compact"
duration = "1 ms"
[[stage.move]]
tool = "top"
displacement = ["0 mm", "0 mm", "-0.1 mm"]
)";

Scene in_space_with(const std::string& text) {
  return load_scene_text(powder_in_space + text, "die.toml").scene;
}

std::string problem_in_space_with(const std::string& text) {
  const auto problems = problems_of(powder_in_space + text);
  return problems.empty() ? "" : problems[0].text();
}

std::string lattice_in_space(const std::string& kind) {
  return "[[packing]]\nkind = \"" + kind +
         "\"\nparticle = \"ball\"\ncells = [3, 2, 2]\ncorner = [\"1 mm\", \"2 mm\", \"3 mm\"]\n";
}

TEST(DieInSpace, IsABoxAroundALattice) {
  const Scene scene = in_space_with(lattice_in_space("cubic") + "[die]\n");
  EXPECT_THAT(names_of(scene),
              testing::ElementsAre("left", "right", "front", "back", "bottom", "top"));
  EXPECT_TRUE(scene.tools[1].point.isApprox(Vec3(0.007, 0.002, 0.003), 1e-12));
  EXPECT_TRUE(scene.tools[3].point.isApprox(Vec3(0.001, 0.006, 0.003), 1e-12));
  EXPECT_TRUE(scene.tools[5].point.isApprox(Vec3(0.001, 0.002, 0.007), 1e-12));
  EXPECT_EQ(scene.tools[3].normal, Vec3(0, -1, 0));
}

// The outermost particles of every lattice touch the walls of its die, and none is behind one.
TEST(DieInSpace, TouchesTheOutermostParticlesOfEveryLattice) {
  for (const char* kind : {"cubic", "body-centred", "face-centred", "hexagonal"}) {
    const Scene scene = in_space_with(lattice_in_space(kind) + "[die]\n");
    const std::vector<BodySpec> bodies = place_bodies(scene);
    ASSERT_EQ(scene.tools.size(), 6U) << kind;
    for (const ToolSpec& tool : scene.tools) {
      double least = 1;
      for (const BodySpec& body : bodies)
        least = std::min(least, (body.position - tool.point).dot(tool.normal));
      EXPECT_NEAR(least, 1e-3, 1e-12) << kind << ' ' << tool.name;
    }
  }
}

TEST(DieInSpace, GivesARandomPackingItsContainer) {
  const std::string bed =
      "[[packing]]\nkind = \"random\"\ndensity = 0.2\nclass = [{ particle = \"ball\", number = 4 "
      "}]\n";
  const Scene box = in_space_with(bed + "[die]\nwidth = \"6 mm\"\ndepth = \"5 mm\"\n");
  EXPECT_DOUBLE_EQ(box.packings[0].container.depth, 0.005);
  EXPECT_DOUBLE_EQ(box.tools[1].point.x(), 0.006);
  EXPECT_DOUBLE_EQ(box.tools[3].point.y(), 0.005);
  const Scene square = in_space_with(bed + "[die]\nwidth = \"6 mm\"\n");
  EXPECT_DOUBLE_EQ(square.packings[0].container.depth, 0.006);
  const Scene round =
      in_space_with(bed + "[die]\ndiameter = \"6 mm\"\ncorner = [\"1 mm\", \"0 mm\", \"2 mm\"]\n");
  EXPECT_THAT(names_of(round), testing::ElementsAre("die", "bottom", "top"));
  EXPECT_EQ(round.tools[0].shape, ToolSpec::Shape::die);
  EXPECT_EQ(round.tools[0].normal, Vec3(0, 0, 1));
  EXPECT_DOUBLE_EQ(round.packings[0].container.diameter, 0.006);
  EXPECT_DOUBLE_EQ(round.tools[1].point.z(), 0.002);
  EXPECT_DOUBLE_EQ(round.tools[2].point.z(), round.packings[0].top);
  // What the packing says, the die need not.
  EXPECT_DOUBLE_EQ(in_space_with(bed + "diameter = \"7 mm\"\n[die]\n").tools[0].diameter, 0.007);
}

TEST(WrongDieInSpace, IsRefusedAtItsPlace) {
  EXPECT_THAT(problem_in_space_with(lattice_in_space("cubic") +
                                    "[die]\nwidth = \"6 mm\"\ndiameter = \"6 mm\"\n"),
              HasSubstr("die.diameter: has no effect together with width or depth"));
  EXPECT_THAT(problem_in_space_with("[die]\n"),
              HasSubstr("die.width: required key is missing, allowed: a quantity in m, or the "
                        "diameter of a cylindrical die"));
  EXPECT_THAT(
      problem_in_space_with(
          lattice_in_space("cubic") +
          "[die]\n[[tool]]\nname = \"back\"\nshape = \"plane\"\npoint = [\"0 mm\", \"9 mm\", "
          "\"0 mm\"]\nnormal = [0, -1, 0]\n"),
      HasSubstr("tool[0].point: is at y = 0.009 m, but this side of the die is at 0.006 m"));
}

}  // namespace
}  // namespace pulvis
