// Wrong polylines and grips are refused at their place, with the reason and what is allowed.
#include <gmock/gmock.h>

#include "right_scene.hpp"
#include "scenes/build.hpp"

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
  return std::string(right_scene) + "[[tool]]\nname = \"third\"\n" + tool + "\n";
}

const std::string grip_on_block =
    "shape = \"grip\"\nlow = [\"0 mm\", \"20 mm\"]\nhigh = [\"0 mm\", \"30 mm\"]\nholds = \"x\"\n";

// While it is read, or, where only the placed nodes can tell, while it is built.
std::vector<SceneProblem> problems_with(const std::string& tool) {
  try {
    build_world(load_scene_text(scene_with(tool), "wrong.toml").scene);
  } catch (const SceneError& error) {
    return error.errors();
  }
  return {};
}

TEST(RightTools, AreAccepted) {
  for (const std::string& tool :
       {std::string("shape = \"polyline\"\npoints = [[\"0 mm\", \"-1 mm\"], [\"9 mm\", \"-2 mm\"], "
                    "[\"20 mm\", \"-1 mm\"]]\nrounding = \"1 mm\""),
        grip_on_block})
    for (const SceneProblem& problem : problems_with(tool)) ADD_FAILURE() << problem.text();
}

class WrongTools : public testing::TestWithParam<WrongTool> {};

TEST_P(WrongTools, AreRefused) {
  const WrongTool& wrong = GetParam();
  const std::vector<SceneProblem> problems = problems_with(wrong.tool);
  ASSERT_FALSE(problems.empty());
  EXPECT_EQ(problems.front().key, wrong.key) << problems.front().text();
  EXPECT_GT(problems.front().line, 70);  // in the tool, which comes last
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
     {"has no effect with shape = \"polyline\""}},
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
     "shape = \"grip\"\nlow = [\"0 mm\", \"0 mm\"]\nhigh = [\"9 mm\", \"9 mm\"]\nholds = "
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
     "shape = \"grip\"\nlow = [\"0 mm\", \"9 mm\"]\nhigh = [\"9 mm\", \"0 mm\"]\nholds = \"x\"",
     "tool[2].high",
     {"the box is empty"}},
    {"NoNodeInTheBox",
     "shape = \"grip\"\nlow = [\"50 mm\", \"0 mm\"]\nhigh = [\"60 mm\", \"9 mm\"]\nholds = \"x\"",
     "tool[2].low",
     {"no node of particle 0 lies in the box"}},
    {"NoSuchBody",
     "shape = \"grip\"\nbody = 5\nlow = [\"0 mm\", \"0 mm\"]\nhigh = [\"60 mm\", \"9 mm\"]\nholds "
     "= "
     "\"x\"",
     "tool[2].body",
     {"there is no particle 5", "<= 4"}},
    {"NodeAtTheCentre",
     "shape = \"grip\"\nlow = [\"0 mm\", \"20 mm\"]\nhigh = [\"20 mm\", \"30 mm\"]\nholds = "
     "\"radial\"\npoint = [\"10 mm\", \"25 mm\"]",
     "tool[2].point",
     {"lies at the centre"}},
    {"HeldTwice",
     "shape = \"grip\"\nlow = [\"0 mm\", \"20 mm\"]\nhigh = [\"0 mm\", \"30 mm\"]\nholds = \"x\"\n"
     "[[tool]]\nname = \"fourth\"\nshape = \"grip\"\nlow = [\"0 mm\", \"30 mm\"]\nhigh = [\"20 "
     "mm\", "
     "\"30 mm\"]\nholds = \"both\"",
     "tool[3].holds",
     {"is held by 'third' and 'fourth' in the same direction"}},
    {"MoveOfAFreeDirection",
     "shape = \"grip\"\nlow = [\"0 mm\", \"20 mm\"]\nhigh = [\"0 mm\", \"30 mm\"]\nholds = \"x\"\n"
     "[[stage]]\nname = \"pull\"\nkind = \"eject\"\nduration = \"1 ms\"\n[[stage.move]]\ntool = "
     "\"third\"\ndisplacement = [\"1 mm\", \"1 mm\"]",
     "stage[1].move[0].displacement",
     {"'third' does not hold its nodes in y"}},
    {"GripThatRubs",
     "shape = \"grip\"\nlow = [\"0 mm\", \"20 mm\"]\nhigh = [\"0 mm\", \"30 mm\"]\nholds = \"x\"\n"
     "[[friction]]\nbetween = [\"316L\", \"third\"]\ncoefficient = 0.1",
     "friction[1].between",
     {"nothing touches the grip 'third'"}},
    {"ShearWithoutMove",
     "shape = \"grip\"\nlow = [\"0 mm\", \"20 mm\"]\nhigh = [\"0 mm\", \"30 mm\"]\nholds = \"x\"\n"
     "[[stage]]\nname = \"draw\"\nkind = \"shear\"\nduration = \"1 ms\"",
     "stage[1].kind",
     {"no tool moves in this stage"}},
};

std::string name_of(const testing::TestParamInfo<WrongTool>& info) { return info.param.name; }

INSTANTIATE_TEST_SUITE_P(Tools, WrongTools, testing::ValuesIn(cases), name_of);

}  // namespace
}  // namespace pulvis
