// Wrong scenes in three dimensions are refused at their place, with the reason and what is allowed.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>

#include "scenes/build.hpp"
#include "scenes/read.hpp"
#include "tests/helpers/right_space_scene.hpp"
#include "tests/helpers/wrong.hpp"

namespace pulvis {
namespace {

using testing::HasSubstr;

struct WrongSpaceScene {
  const char* name;
  std::vector<std::string> set;         // as for --set
  std::array<const char*, 2> replaced;  // in the text, by what
  const char* key;
  std::vector<const char*> says;
};

void PrintTo(const WrongSpaceScene& wrong, std::ostream* stream) { *stream << wrong.name; }

constexpr std::array<const char*, 2> as_it_is{"", ""};

// While it is read, or, where only the placed particles can tell, while it is built.
std::vector<SceneProblem> problems_in_space(const WrongSpaceScene& wrong) {
  std::string text = right_space_scene;
  const std::string from = wrong.replaced[0];
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos);
  text.replace(at, from.size(), wrong.replaced[1]);
  return problems_in([&] { build_world(load_scene_text(text, "wrong.toml", wrong.set).scene); });
}

class WrongSpaceScenes : public testing::TestWithParam<WrongSpaceScene> {};

TEST_P(WrongSpaceScenes, AreRefused) {
  const auto problems = problems_in_space(GetParam());
  const auto found = std::ranges::find(problems, GetParam().key, &SceneProblem::key);
  ASSERT_NE(found, problems.end()) << (problems.empty() ? "accepted" : problems[0].text());
  for (const char* words : GetParam().says) EXPECT_THAT(found->message, HasSubstr(words));
  EXPECT_THAT(found->message, HasSubstr("allowed: "));
}

constexpr const char* time_table = "[time]\n";
constexpr const char* lattice = "kind = \"cubic\"\nparticle = \"ball\"\ncells = [2, 2, 1]\n";
constexpr const char* one_move =
    "[[stage.move]]\ntool = \"top\"\ndisplacement = [\"0 mm\", \"0 mm\", \"-1 mm\"]\n";
constexpr const char* pill_sizes = "shape = \"cylinder\"\ndiameter = \"8 mm\"\nheight = \"6 mm\"\n";
const std::vector<WrongSpaceScene> wrong_in_space{
    {"Thickness", {"thickness=1 mm"}, as_it_is, "thickness", {"two dimensions", "dimension = 3"}},
    {"SolidsWithoutADimension",
     {},
     {"dimension = 3\n", ""},
     "particle.shape",
     {"three dimensions", "`dimension = 3`"}},
    {"ElementsThatTakeMinutesToMake",
     {"particle.ball.mesh.divisions=64", "particle.ball.mesh.rings=64"},
     as_it_is,
     "particle[0].mesh.divisions",
     {"1835008 elements", "at most 100000"}},
    {"BondsInside",
     {},
     {time_table,
      "[[bond]]\nbetween = [\"316L\", \"316L\"]\norigin = \"initial\"\nstrength = \"1 MPa\"\n"
      "fracture_energy = \"1 kJ/m^2\"\ninside = true\n\n[time]\n"},
     "bond[0].inside",
     {"two dimensions"}},
    {"BondsTooBrittle",
     {},
     {time_table,
      "[[bond]]\nbetween = [\"316L\", \"316L\"]\norigin = \"pressed\"\nthreshold = \"1 "
      "MPa\"\ngrowth = 1\nstrength = \"1 GPa\"\nfracture_energy = \"1 J/m^2\"\n\n[time]\n"},
     "bond[0].fracture_energy",
     {"smaller faces"}},
    {"BondsOfTwoTools",
     {},
     {time_table,
      "[[bond]]\nbetween = [\"top\", \"bottom\"]\norigin = \"adhesion\"\nwork = \"1 J/m^2\"\n"
      "range = \"1 um\"\n\n[time]\n"},
     "bond[0].between",
     {"never touch"}},
    {"Cell", {}, {time_table, "[cell]\nwidth = \"10 mm\"\n\n[time]\n"}, "cell.depth", {"required key is missing"}},
    {"Outline", {"particle[0].outline=disc"}, as_it_is, "particle[0].outline", {"shape"}},
    {"Grains", {"particle[0].grains.number=3"}, as_it_is, "particle[0].grains", {"two dim"}},
    {"Damping",
     {"material[0].damping.mass_proportional=-1 1/s"},
     as_it_is,
     "material[0].damping.mass_proportional",
     {">= 0"}},
    {"Shear", {"stage.press.kind=shear"}, as_it_is, "stage[0].kind", {"two dimensions", "compact"}},
    {"NothingMoves",
     {},
     {one_move, ""},
     "stage[0].kind",
     {"no tool moves", "one [[stage.move]] or [[stage.servo]], a [stage.cell], or kind = "}},
    {"ShortVector",
     {"tool.top.point=[\"0 mm\", \"20 mm\"]"},
     as_it_is,
     "tool[1].point",
     {"length 2", "[x, y, z]"}},
    {"FourDimensions", {"dimension=4"}, as_it_is, "dimension", {"allowed: 2 or 3"}},
    {"OfAVariable", {"let.d=3", "dimension=d"}, as_it_is, "dimension", {"expression"}},
    {"Rounding", {"particle.pill.rounding=5 mm"}, as_it_is, "particle[1].rounding", {"half"}},
    {"ExtrudedRounding",
     {"particle.pill.mesh.grid=extruded", "particle.pill.mesh.divisions=4",
      "particle.pill.mesh.rings=2"},
     as_it_is,
     "particle[1].rounding",
     {"half of an element"}},
    {"ExtrudedByOne",
     {"particle.pill.mesh.grid=extruded", "particle.pill.mesh.divisions=1",
      "particle.pill.mesh.rings=2"},
     as_it_is,
     "particle[1].mesh.grid",
     {"divisions"}},
    {"ExtrudedBall",
     {"particle.ball.mesh.grid=extruded"},
     as_it_is,
     "particle[0].mesh.grid",
     {"cylinder"}},
    {"FlatPolyhedron",
     {},
     {pill_sizes,
      "shape = \"polyhedron\"\ncorners = [[\"0 mm\", \"0 mm\", \"0 mm\"], [\"9 mm\", \"0 mm\", \"0 "
      "mm\"], [\"0 mm\", \"9 mm\", \"0 mm\"], [\"9 mm\", \"9 mm\", \"0 mm\"]]\n"},
     "particle[1].corners",
     {"one plane"}},
    // Three faces of the cube end in each of its corners: two divisions leave nothing of them.
    {"FoldedSurface",
     {"particle.pill.mesh.divisions=2", "particle.pill.rounding=0.01 mm"},
     {pill_sizes,
      "shape = \"polyhedron\"\ncorners = [[\"0 mm\", \"0 mm\", \"0 mm\"], [\"4 mm\", \"0 mm\", \"0 "
      "mm\"], [\"0 mm\", \"4 mm\", \"0 mm\"], [\"0 mm\", \"0 mm\", \"4 mm\"]]\n"},
     "particle[1].mesh",
     {"folded", "too coarse", "rounder shape"}},
    {"NothingLeftOfAPolyhedron",
     {"particle.pill.rounding=0.85 mm"},
     {pill_sizes,
      "shape = \"polyhedron\"\ncorners = [[\"0 mm\", \"0 mm\", \"0 mm\"], [\"4 mm\", \"0 mm\", \"0 "
      "mm\"], [\"0 mm\", \"4 mm\", \"0 mm\"], [\"0 mm\", \"0 mm\", \"4 mm\"]]\n"},
     "particle[1].rounding",
     {"leaves nothing", "below 0.0008453 m"}},  // 4 mm / (3 + sqrt 3)
    {"MouthOfAPlane", {"tool.top.height=5 mm"}, as_it_is, "tool[1].height", {"die"}},
    {"EdgeWithoutAMouth",
     {"tool.top.shape=die", "tool.top.diameter=40 mm", "tool.top.rounding=1 mm"},
     as_it_is,
     "tool[1].rounding",
     {"height"}},
    {"NoContainer",
     {},
     {lattice, "kind = \"random\"\ndensity = 0.5\n[[packing.class]]\nparticle = \"ball\"\n"},
     "packing[0].width",
     {"depth"}},
    {"TwoContainers",
     {},
     {lattice,
      "kind = \"random\"\ndensity = 0.5\ndiameter = \"20 mm\"\nwidth = \"20 mm\"\ndepth = \"20 "
      "mm\"\n[[packing.class]]\nparticle = \"ball\"\nnumber = 3\n"},
     "packing[0].diameter",
     {"width"}},
    {"Density",
     {"stage.press.until.relative_density=0.9"},
     as_it_is,
     "stage[0].until.relative_density",
     {"no die"}},
    {"TwiceMoved",
     {},
     {one_move,
      "[[stage.move]]\ntool = \"top\"\ndisplacement = [\"0 mm\", \"0 mm\", \"-1 "
      "mm\"]\n\n[[stage.move]]\ntool = \"top\"\ndisplacement = [\"0 mm\", \"0 mm\", \"-1 mm\"]\n"},
     "stage[0].move[1].tool",
     {"twice"}},
    {"ServoWithoutDirection",
     {"tool.top.shape=die", "tool.top.diameter=90 mm", "tool.top.normal=[0, 0, 1]"},
     {one_move, "[[stage.servo]]\ntool = \"top\"\nforce = \"1 N\"\n"},
     "stage[0].servo[0].direction",
     {"normal"}},
    {"ServoThatPulls",
     {},
     {one_move, "[[stage.servo]]\ntool = \"top\"\nforce = \"1 N\"\ndirection = [0, 0, 1]\n"},
     "stage[0].servo[0].direction",
     {"away from the powder"}},
    {"UntilItHasMovedTooFar",
     {"stage.press.until.tool=top", "stage.press.until.displacement=2 mm"},
     as_it_is,
     "stage[0].until.displacement",
     {"0.002 m cannot be reached", "0.001 m"}},
    {"UntilWhatStandsHasMoved",
     {"stage.press.until.tool=bottom", "stage.press.until.displacement=1 mm"},
     as_it_is,
     "stage[0].until.displacement",
     {"by 0 m"}},
    {"AxisWithoutAngle",
     {},
     {"angle = \"30 deg\"\n", ""},
     "body[0].axis",
     {"no effect without angle"}},
    {"Overlap",
     {"body[0].position=[\"10 mm\", \"10 mm\", \"10 mm\"]"},
     as_it_is,
     "packing[0]",
     {"overlap"}},
    {"BehindATool",
     {"tool.top.point=[\"0 mm\", \"0 mm\", \"16 mm\"]"},
     as_it_is,
     "body[0].position",
     {"tool 'top'"}},
};

INSTANTIATE_TEST_SUITE_P(Of, WrongSpaceScenes, testing::ValuesIn(wrong_in_space),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(RightSpaceScene, IsAccepted) {
  EXPECT_TRUE(problems_in_space({"Right", {}, as_it_is, "", {}}).empty());
}

// ---- constraints ------------------------------------------------------------------------------------
// `keys`: of a third tool, and what follows it. The pill is at (10, 10, 15) mm, 8 mm wide and 6 mm high.
struct WrongConstraint {
  const char* name;
  std::string keys;
  const char* key;
  std::vector<const char*> says;
};

void PrintTo(const WrongConstraint& wrong, std::ostream* stream) { *stream << wrong.name; }

std::vector<SceneProblem> problems_of_constraint(const std::string& keys) {
  const std::string text =
      right_space_scene + std::string("[[tool]]\nname = \"held\"\nshape = \"constraint\"\n") + keys;
  return problems_in([&] { build_world(load_scene_text(text, "wrong.toml").scene); });
}

const std::string on_pill =
    "low = [\"6 mm\", \"6 mm\", \"17 mm\"]\nhigh = [\"14 mm\", \"14 mm\", \"19 mm\"]\n";
const std::string stage_with =
    "[[stage]]\nname = \"draw\"\nkind = \"eject\"\nduration = \"1 ms\"\n";
const std::vector<WrongConstraint> wrong_constraints{
    {"WithoutABox", "holds = \"z\"\n", "tool[2].low", {"three quantities [x, y, z]", "radius"}},
    {"OfBothAxes", on_pill + "holds = \"both\"\n", "tool[2].holds", {"two dimensions", "all"}},
    {"OfNothing", on_pill, "tool[2].holds", {"required"}},
    {"EmptyBox",
     "low = [\"6 mm\", \"6 mm\", \"18 mm\"]\nhigh = [\"14 mm\", \"14 mm\", \"17 mm\"]\nholds = "
     "\"z\"\n",
     "tool[2].high",
     {"the box is empty"}},
    {"BoxWithoutNodes",
     "low = [\"6 mm\", \"6 mm\", \"19 mm\"]\nhigh = [\"14 mm\", \"14 mm\", \"19 mm\"]\nholds = "
     "\"z\"\n",
     "tool[2].low",
     {"no node of particle 0", "at least one node"}},
    {"SphereWithoutNodes",
     "point = [\"10 mm\", \"10 mm\", \"19 mm\"]\nradius = \"0.5 mm\"\nholds = \"z\"\n",
     "tool[2].radius",
     {"no node of particle 0", "at least 0.0019"}},
    {"RadiusWithoutAPoint",
     "radius = \"1 mm\"\nholds = \"z\"\n",
     "tool[2].point",
     {"required key is missing", "three quantities"}},
    {"PointOfABox",
     "point = [\"10 mm\", \"10 mm\", \"18 mm\"]\n" + on_pill + "holds = \"z\"\n",
     "tool[2].point",
     {"has no effect", "radius"}},
    {"RadiusAndBox",
     "point = [\"10 mm\", \"10 mm\", \"18 mm\"]\nradius = \"1 mm\"\n" + on_pill + "holds = \"z\"\n",
     "tool[2].low",
     {"has no effect together with radius"}},
    {"Normal",
     on_pill + "holds = \"z\"\nnormal = [0, 0, 1]\n",
     "tool[2].normal",
     {"has no effect with shape"}},
    {"CentreOfTheRadius",
     "body = 1\npoint = [\"5 mm\", \"5 mm\", \"5 mm\"]\nradius = \"1 mm\"\nholds = \"radial\"\n",
     "tool[2].point",
     {"lies at the centre"}},
    {"NoSuchBody",
     "body = 9\n" + on_pill + "holds = \"z\"\n",
     "tool[2].body",
     {"there is no particle 9", "<= 4"}},
    {"HeldTwice",
     on_pill +
         "holds = \"all\"\n[[tool]]\nname = \"again\"\nshape = \"constraint\"\nholds = \"z\"\n" +
         on_pill,
     "tool[3].holds",
     {"is held by 'held' and 'again' in the same direction"}},
    {"MoveOfAFreeDirection",
     on_pill + "holds = \"z\"\n" + stage_with +
         "move = [{ tool = \"held\", displacement = [\"0 mm\", \"1 mm\", \"1 mm\"] }]\n",
     "stage[1].move[0].displacement",
     {"'held' does not hold its nodes in y"}},
    {"RadialMoveAcross",
     "point = [\"20 mm\", \"10 mm\", \"15 mm\"]\n" + on_pill + "holds = \"radial\"\n" + stage_with +
         "move = [{ tool = \"held\", displacement = [\"1 mm\", \"0 mm\", \"1 mm\"] }]\n",
     "stage[1].move[0].displacement",
     {"in z", "as the first component"}},
    {"ServoOfAConstraint",
     on_pill + "holds = \"z\"\n" + stage_with + "servo = [{ tool = \"held\", force = \"1 N\" }]\n",
     "stage[1].servo[0].tool",
     {"'held' is a constraint"}},
    {"SpringOfAConstraint",
     on_pill + "holds = \"z\"\n" + stage_with +
         "move = [{ tool = \"held\", displacement = [\"0 mm\", \"0 mm\", \"1 mm\"], stiffness = "
         "\"1e6 N/m\", mass = \"1 kg\" }]\n",
     "stage[1].move[0].stiffness",
     {"'held' is a constraint"}},
    {"Friction",
     on_pill + "holds = \"z\"\n[[friction]]\nbetween = [\"316L\", \"held\"]\ncoefficient = 0.1\n",
     "friction[1].between",
     {"the constraint 'held' has no contact"}},
};

class WrongConstraints : public testing::TestWithParam<WrongConstraint> {};

TEST_P(WrongConstraints, AreRefused) {
  const auto problems = problems_of_constraint(GetParam().keys);
  const auto found = std::ranges::find(problems, GetParam().key, &SceneProblem::key);
  ASSERT_NE(found, problems.end()) << (problems.empty() ? "accepted" : problems[0].text());
  for (const char* words : GetParam().says) EXPECT_THAT(found->message, HasSubstr(words));
  EXPECT_THAT(found->message, HasSubstr("allowed: "));
  EXPECT_GT(found->line, 0);
}

INSTANTIATE_TEST_SUITE_P(InSpace, WrongConstraints, testing::ValuesIn(wrong_constraints),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(RightConstraintInSpace, IsAccepted) {
  for (const std::string& keys :
       {on_pill + "holds = \"all\"\n",
        on_pill + "holds = \"radial\"\npoint = [\"0 mm\", \"0 mm\", \"0 mm\"]\n",
        std::string(
            "point = [\"10 mm\", \"10 mm\", \"15 mm\"]\nradius = \"3 mm\"\nholds = \"x\"\n")})
    for (const SceneProblem& problem : problems_of_constraint(keys))
      ADD_FAILURE() << problem.text();
}

}  // namespace
}  // namespace pulvis
