// Wrong polylines and constraints are refused at their place, with the reason and what is allowed.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>

#include "scenes/build.hpp"
#include "tests/helpers/right_scene.hpp"
#include "tests/helpers/wrong.hpp"

namespace pulvis {
namespace {

using testing::HasSubstr;

struct WrongTool {
  const char* name;
  const char* tool;  // what follows the name of a third tool
  const char* key;
  std::vector<const char*> says;
};

void PrintTo(const WrongTool& wrong, std::ostream* stream) { *stream << wrong.name; }

std::string scene_with(const std::string& tool) {
  return fmt::format("{}[[tool]]\nname = \"third\"\n{}\n", right_scene, tool);
}

const std::string constraint_in_block =
    "shape = \"constraint\"\npoint = [\"10 mm\", \"25 mm\"]\nradius = \"6 mm\"\nholds = \"both\"\n";

const std::string constraint_on_block =
    "shape = \"constraint\"\nlow = [\"0 mm\", \"20 mm\"]\nhigh = [\"0 mm\", \"30 mm\"]\nholds = "
    "\"x\"\n";

// While it is read, or, where only the placed nodes can tell, while it is built.
std::vector<SceneProblem> problems_with(const std::string& tool) {
  return problems_in([&] { build_world(load_scene_text(scene_with(tool), "wrong.toml").scene); });
}

TEST(RightTools, AreAccepted) {
  for (const std::string& tool :
       {std::string("shape = \"polyline\"\npoints = [[\"0 mm\", \"-1 mm\"], [\"9 mm\", \"-2 mm\"], "
                    "[\"20 mm\", \"-1 mm\"]]\nrounding = \"1 mm\""),
        constraint_on_block, constraint_in_block})
    for (const SceneProblem& problem : problems_with(tool)) ADD_FAILURE() << problem.text();
}

class WrongTools : public testing::TestWithParam<WrongTool> {};

TEST_P(WrongTools, AreRefused) {
  const WrongTool& wrong = GetParam();
  const std::vector<SceneProblem> problems = problems_with(wrong.tool);
  ASSERT_FALSE(problems.empty());
  EXPECT_EQ(problems.front().key, wrong.key) << problems.front().text();
  const std::string right = right_scene;
  const auto lines = std::count(right.begin(), right.end(), '\n');
  const bool in_the_tool = problems.front().line > lines;  // it comes last
  EXPECT_EQ(in_the_tool, wrong.key != std::string("packing[0]")) << problems.front().line;
  EXPECT_THAT(problems.front().message, HasSubstr("allowed: "));
  for (const char* part : wrong.says) EXPECT_THAT(problems.front().message, HasSubstr(part));
}

const WrongTool cases[] = {
    {"OnePoint",
     "shape = \"polyline\"\npoints = [[\"0 mm\", \"0 mm\"]]",
     "tool[2].points",
     {"an array of length 1 is given", "at least two points"}},
    {"NoPoints", "shape = \"polyline\"", "tool[2].points", {"required key is missing"}},
    {"BareNumbers",
     "shape = \"polyline\"\npoints = [[0, 0], [1, 0]]",
     "tool[2].points",
     {"missing unit"}},
    {"SamePoints",
     "shape = \"polyline\"\npoints = [[\"0 mm\", \"-1 mm\"], [\"1 mm\", \"-1 mm\"], [\"1 mm\", "
     "\"-1 mm\"]]",
     "tool[2].points",
     {"points 1 and 2 are the same"}},
    {"TurnsBack",
     "shape = \"polyline\"\npoints = [[\"0 mm\", \"-1 mm\"], [\"2 mm\", \"-1 mm\"], [\"1 mm\", "
     "\"-1 mm\"]]",
     "tool[2].points",
     {"turns back on itself at point 1"}},
    {"Crosses",
     "shape = \"polyline\"\npoints = [[\"0 mm\", \"-1 mm\"], [\"4 mm\", \"-1 mm\"], [\"4 mm\", "
     "\"-3 "
     "mm\"], [\"2 mm\", \"-3 mm\"], [\"2 mm\", \"0 mm\"]]",
     "tool[2].points",
     {"from point 0 to point 1 meets that from point 3 to point 4"}},
    {"EndsCrossFarAway",
     "shape = \"polyline\"\npoints = [[\"0 mm\", \"-3 mm\"], [\"1 mm\", \"-2 mm\"], [\"2 mm\", "
     "\"-2 "
     "mm\"], [\"3 mm\", \"-3 mm\"], [\"2 mm\", \"-3 mm\"]]",
     "tool[2].points",
     {"meets"}},
    {"RoundingTooLarge",
     "shape = \"polyline\"\npoints = [[\"0 mm\", \"-9 mm\"], [\"1 mm\", \"-2 mm\"], [\"2 mm\", "
     "\"-2 "
     "mm\"], [\"3 mm\", \"-9 mm\"]]\nrounding = \"2 mm\"",
     "tool[2].rounding",
     {"the straight part from point 1 to point 2, which is 0.001 m long", "allowed: <= 0.000"}},
    {"NormalOfAPolyline",
     "shape = \"polyline\"\npoints = [[\"0 mm\", \"-1 mm\"], [\"1 mm\", \"-1 mm\"]]\nnormal = [0, "
     "1]",
     "tool[2].normal",
     {"only with shape = \"plane\", or with a file of a polyline"}},
    {"PointOfAPolyline",
     "shape = \"polyline\"\npoints = [[\"0 mm\", \"-1 mm\"], [\"1 mm\", \"-1 mm\"]]\npoint = [\"0 "
     "mm\", \"0 mm\"]",
     "tool[2].point",
     {"has no effect", "shape = \"plane\""}},
    {"PlaneWithoutPoint",
     "shape = \"plane\"\nnormal = [0, 1]",
     "tool[2].point",
     {"required key is missing"}},
    {"RadialWithoutCentre",
     "shape = \"constraint\"\nlow = [\"0 mm\", \"0 mm\"]\nhigh = [\"9 mm\", \"9 mm\"]\nholds = "
     "\"radial\"",
     "tool[2].point",
     {"required key is missing"}},
    {"ParticleBehindAPolyline",
     "shape = \"polyline\"\npoints = [[\"-9 mm\", \"-1 mm\"], [\"4 mm\", \"-1 mm\"], [\"5 mm\", "
     "\"0.2 "
     "mm\"], [\"6 mm\", \"-1 mm\"]]",
     "packing[0]",
     {"behind tool 'third'"}},
    {"HighBelowLow",
     "shape = \"constraint\"\nlow = [\"0 mm\", \"9 mm\"]\nhigh = [\"9 mm\", \"0 mm\"]\nholds = "
     "\"x\"",
     "tool[2].high",
     {"the box is empty"}},
    {"NoNodeInTheBox",
     "shape = \"constraint\"\nlow = [\"50 mm\", \"0 mm\"]\nhigh = [\"60 mm\", \"9 mm\"]\nholds = "
     "\"x\"",
     "tool[2].low",
     {"no node of particle 0 lies in the box"}},
    {"NoNodeWithinTheRadius",
     "shape = \"constraint\"\npoint = [\"-1 mm\", \"20 mm\"]\nradius = \"0.9 mm\"\nholds = \"x\"",
     "tool[2].radius",
     {"no node of particle 0 lies within it", "allowed: at least 0.001 m"}},
    {"RadiusBesideABox",
     "shape = \"constraint\"\npoint = [\"0 mm\", \"20 mm\"]\nradius = \"9 mm\"\nlow = [\"0 mm\", "
     "\"20 "
     "mm\"]\n"
     "holds = \"x\"",
     "tool[2].low",
     {"has no effect together with radius", "low and high, or radius alone"}},
    {"NeitherBoxNorRadius",
     "shape = \"constraint\"\nholds = \"x\"",
     "tool[2].low",
     {"required key is missing", "or radius instead of low and high"}},
    {"HalfABox",
     "shape = \"constraint\"\nlow = [\"0 mm\", \"20 mm\"]\nholds = \"x\"",
     "tool[2].high",
     {"required key is missing"}},
    {"RadiusWithoutCentre",
     "shape = \"constraint\"\nradius = \"9 mm\"\nholds = \"x\"",
     "tool[2].point",
     {"required key is missing: it is the centre of the radius"}},
    {"RadiusOfZero",
     "shape = \"constraint\"\npoint = [\"0 mm\", \"20 mm\"]\nradius = \"0 mm\"\nholds = \"x\"",
     "tool[2].radius",
     {}},
    {"RadiusOfAPlane",
     "shape = \"plane\"\npoint = [\"0 mm\", \"-9 mm\"]\nnormal = [0, 1]\nradius = \"9 mm\"",
     "tool[2].radius",
     {"has no effect with shape = \"plane\""}},
    {"PointOfABoxThatHoldsX",
     "shape = \"constraint\"\npoint = [\"0 mm\", \"20 mm\"]\nlow = [\"0 mm\", \"20 mm\"]\nhigh = "
     "[\"0 "
     "mm\", "
     "\"30 mm\"]\nholds = \"x\"",
     "tool[2].point",
     {"has no effect", "or a radius"}},
    {"NodeAtTheCentreOfTheRadius",
     "shape = \"constraint\"\npoint = [\"10 mm\", \"25 mm\"]\nradius = \"6 mm\"\nholds = "
     "\"radial\"",
     "tool[2].point",
     {"lies at the centre"}},
    {"NoSuchBody",
     "shape = \"constraint\"\nbody = 5\nlow = [\"0 mm\", \"0 mm\"]\nhigh = [\"60 mm\", \"9 "
     "mm\"]\nholds "
     "= "
     "\"x\"",
     "tool[2].body",
     {"there is no particle 5", "<= 4"}},
    {"NodeAtTheCentre",
     "shape = \"constraint\"\nlow = [\"0 mm\", \"20 mm\"]\nhigh = [\"20 mm\", \"30 mm\"]\nholds = "
     "\"radial\"\npoint = [\"10 mm\", \"25 mm\"]",
     "tool[2].point",
     {"lies at the centre"}},
    {"HeldTwice",
     "shape = \"constraint\"\nlow = [\"0 mm\", \"20 mm\"]\nhigh = [\"0 mm\", \"30 mm\"]\nholds = "
     "\"x\"\n"
     "[[tool]]\nname = \"fourth\"\nshape = \"constraint\"\nlow = [\"0 mm\", \"30 mm\"]\nhigh = "
     "[\"20 "
     "mm\", "
     "\"30 mm\"]\nholds = \"both\"",
     "tool[3].holds",
     {"is held by 'third' and 'fourth' in the same direction"}},
    {"MoveOfAFreeDirection",
     "shape = \"constraint\"\nlow = [\"0 mm\", \"20 mm\"]\nhigh = [\"0 mm\", \"30 mm\"]\nholds = "
     "\"x\"\n"
     "[[stage]]\nname = \"pull\"\nkind = \"eject\"\nduration = \"1 ms\"\n[[stage.move]]\ntool = "
     "\"third\"\ndisplacement = [\"1 mm\", \"1 mm\"]",
     "stage[1].move[0].displacement",
     {"'third' does not hold its nodes in y"}},
    {"ConstraintThatRubs",
     "shape = \"constraint\"\nlow = [\"0 mm\", \"20 mm\"]\nhigh = [\"0 mm\", \"30 mm\"]\nholds = "
     "\"x\"\n"
     "[[friction]]\nbetween = [\"316L\", \"third\"]\ncoefficient = 0.1",
     "friction[1].between",
     {"the constraint 'third' has no contact"}},
    {"ShearWithoutMove",
     "shape = \"constraint\"\nlow = [\"0 mm\", \"20 mm\"]\nhigh = [\"0 mm\", \"30 mm\"]\nholds = "
     "\"x\"\n"
     "[[stage]]\nname = \"draw\"\nkind = \"shear\"\nduration = \"1 ms\"",
     "stage[1].kind",
     {"no tool moves in this stage"}},
};

std::string name_of(const testing::TestParamInfo<WrongTool>& info) { return info.param.name; }

INSTANTIATE_TEST_SUITE_P(Tools, WrongTools, testing::ValuesIn(cases), name_of);

}  // namespace
}  // namespace pulvis
