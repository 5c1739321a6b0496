// Wrong scenes in three dimensions are refused at their place, with the reason and what is allowed.
#include <gmock/gmock.h>

#include <algorithm>

#include "scenes/build.hpp"
#include "scenes/read.hpp"
#include "tests/helpers/right_space_scene.hpp"
#include "tests/helpers/wrong.hpp"

namespace pulvis {
namespace {

using testing::HasSubstr;

struct WrongSpaceScene {
  const char* name;
  std::vector<std::string> set;
  const char* key;
  std::vector<const char*> says;
};

void PrintTo(const WrongSpaceScene& wrong, std::ostream* stream) { *stream << wrong.name; }

// While it is read, or, where only the placed particles can tell, while it is built.
std::vector<SceneProblem> problems_in_space(const std::vector<std::string>& set) {
  return problems_in(
      [&] { build_world(load_scene_text(right_space_scene, "wrong.toml", set).scene); });
}

class WrongSpaceScenes : public testing::TestWithParam<WrongSpaceScene> {};

TEST_P(WrongSpaceScenes, AreRefused) {
  const auto problems = problems_in_space(GetParam().set);
  const auto found = std::ranges::find(problems, GetParam().key, &SceneProblem::key);
  ASSERT_NE(found, problems.end()) << (problems.empty() ? "accepted" : problems[0].text());
  for (const char* words : GetParam().says) EXPECT_THAT(found->message, HasSubstr(words));
  EXPECT_THAT(found->message, HasSubstr("allowed: "));
}

const std::vector<WrongSpaceScene> wrong_in_space{
    {"Thickness", {"thickness=1 mm"}, "thickness", {"belongs to two dimensions", "dimension = 3"}},
    {"Bonds",
     {"bond=[{between=[\"316L\", \"316L\"], strength=\"1 MPa\"}]"},
     "bond",
     {"belongs to two dimensions"}},
    {"Cell", {"cell={width=\"10 mm\"}"}, "cell", {"belongs to two dimensions"}},
    {"Outline", {"particle[0].outline=disc"}, "particle[0].outline", {"shape"}},
    {"Grains", {"particle[0].grains={number=3}"}, "particle[0].grains", {"two dimensions"}},
    {"Damping",
     {"material[0].damping={mass_proportional=\"1 1/s\"}"},
     "material[0].damping",
     {"two dimensions"}},
    {"Constraint", {"tool.top.shape=constraint"}, "tool[1].shape", {"two dimensions", "plane"}},
    {"Shear", {"stage.press.kind=shear"}, "stage[0].kind", {"two dimensions", "compact"}},
    {"ShortVector",
     {"tool.top.point=[\"0 mm\", \"20 mm\"]"},
     "tool[1].point",
     {"length 2", "[x, y, z]"}},
    {"FourDimensions", {"dimension=4"}, "dimension", {"out of range"}},
    {"OfAVariable", {"let.d=3", "dimension=d"}, "dimension", {"expression"}},
    {"Rounding", {"particle.pill.rounding=5 mm"}, "particle[1].rounding", {"half"}},
    {"FlatPolyhedron",
     {"particle[1]={name=\"pill\", material=\"316L\", shape=\"polyhedron\", rounding=\"1 mm\", "
      "corners=[[\"0 mm\", \"0 mm\", \"0 mm\"], [\"9 mm\", \"0 mm\", \"0 mm\"], [\"0 mm\", \"9 "
      "mm\", \"0 mm\"], [\"9 mm\", \"9 mm\", \"0 mm\"]]}"},
     "particle[1].corners",
     {"one plane"}},
    {"NoContainer",
     {"packing[0]={kind=\"random\", density=0.5, class=[{particle=\"ball\", number=3}]}"},
     "packing[0].width",
     {"depth"}},
    {"TwoContainers",
     {"packing[0]={kind=\"random\", density=0.5, diameter=\"20 mm\", width=\"20 mm\", depth=\"20 "
      "mm\", class=[{particle=\"ball\", number=3}]}"},
     "packing[0].diameter",
     {"width"}},
    {"Density",
     {"stage.press.until={relative_density=0.9}"},
     "stage[0].until.relative_density",
     {"no die"}},
    {"TwiceMoved",
     {"stage.press.move=[{tool=\"top\", displacement=[\"0 m\", \"0 m\", \"-1 mm\"]}, "
      "{tool=\"top\", displacement=[\"0 m\", \"0 m\", \"-1 mm\"]}]"},
     "stage[0].move[1].tool",
     {"twice"}},
    {"ServoWithoutDirection",
     {"tool.top={name=\"top\", shape=\"die\", point=[\"10 mm\", \"10 mm\", \"0 m\"], "
      "diameter=\"40 mm\"}",
      "stage.press.move=[{tool=\"bottom\", displacement=[\"0 m\", \"0 m\", \"1 mm\"]}]",
      "stage.press.servo=[{tool=\"top\", force=\"1 N\"}]"},
     "stage[0].servo[0].direction",
     {"normal"}},
    {"Overlap", {"body[0].position=[\"10 mm\", \"10 mm\", \"10 mm\"]"}, "packing[0]", {"overlap"}},
    {"BehindATool",
     {"tool.top.point=[\"0 mm\", \"0 mm\", \"16 mm\"]"},
     "body[0].position",
     {"behind tool 'top'"}},
};

INSTANTIATE_TEST_SUITE_P(Of, WrongSpaceScenes, testing::ValuesIn(wrong_in_space),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(RightSpaceScene, IsAccepted) { EXPECT_TRUE(problems_in_space({}).empty()); }

}  // namespace
}  // namespace pulvis
