// What cannot be observed of a scene is refused at its key, with the reason and what is allowed.
#include <gmock/gmock.h>

#include "tests/helpers/paths.hpp"
#include "tests/helpers/right_scene.hpp"

namespace pulvis {
namespace {

using testing::HasSubstr;

// The right scene has a bottom and a top only.
const std::string walls = R"(
[[tool]]
name = "left"
shape = "polyline"
points = [["0 mm", "40 mm"], ["0 mm", "-10 mm"]]

[[tool]]
name = "right"
shape = "plane"
point = ["20 mm", "0 mm"]
normal = [-1, 0]
)";

struct WrongOutput {
  std::string output;
  bool enclosed;
  const char* key;
  const char* says;
};

class WrongOutputs : public testing::TestWithParam<WrongOutput> {};

TEST_P(WrongOutputs, AreRefused) {
  const WrongOutput& wrong = GetParam();
  const std::string text =
      right_scene + (wrong.enclosed ? walls : "") + "[output]\n" + wrong.output;
  const std::vector<SceneProblem> problems = problems_of(text);
  ASSERT_FALSE(problems.empty());
  EXPECT_EQ(problems.front().key, wrong.key) << problems.front().text();
  EXPECT_THAT(problems.front().text(), HasSubstr(wrong.says));
  EXPECT_THAT(problems.front().text(), HasSubstr("allowed: "));
  const auto lines = std::count(text.begin(), text.end(), '\n');
  EXPECT_EQ(problems.front().line, lines + 1);  // the key's, which is the last
}

INSTANTIATE_TEST_SUITE_P(
    Of, WrongOutputs,
    testing::Values(
        WrongOutput{"density_cells = [5, 5]", false, "output.density_cells", "do not enclose"},
        WrongOutput{"density_cells = [5, 0]", true, "output.density_cells", "0 is out of range"},
        WrongOutput{"density_cells = [5]", true, "output.density_cells", "length 1"},
        WrongOutput{"density_cells = [5, 5.5]", true, "output.density_cells", "a number is given"},
        WrongOutput{"density_cells = 5", true, "output.density_cells", "an integer is given"},
        WrongOutput{"contacts = \"yes\"", true, "output.contacts", "true or false"},
        WrongOutput{"particle_stress = 1", true, "output.particle_stress", "true or false"}));

TEST(RightOutput, IsAccepted) {
  const Scene scene = load_scene_text(std::string(right_scene) + walls +
                                          "[output]\ndensity_cells = [2, 7]\ncontacts = true\n",
                                      "right.toml")
                          .scene;
  EXPECT_EQ(scene.output.density_cells, (std::array{2, 7}));
  EXPECT_TRUE(scene.output.contacts);
  EXPECT_TRUE(scene.observes_stress());
}

TEST(WrongOutput, ContactsOfAParticleThatNothingCanTouch) {
  const auto problems = problems_in([] {
    read_scene(paths::source_dir() + "/scenes/basic/spinning-disc.toml", {"output.contacts=true"});
  });
  ASSERT_FALSE(problems.empty());
  EXPECT_EQ(problems.front().key, "output.contacts");
  EXPECT_THAT(problems.front().text(), HasSubstr("nothing can touch"));
}

}  // namespace
}  // namespace pulvis
