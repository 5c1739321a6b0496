// Keys and words of older scenes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/helpers/lever.hpp"
#include "tests/helpers/right_scene.hpp"

namespace pulvis {
namespace {

using testing::HasSubstr;

// A key or word that had another name is refused with the new one, and nothing else is said.
void expect_only(const std::string& text, const std::string& key, const std::string& message) {
  const std::vector<SceneProblem> problems = problems_of(text);
  ASSERT_EQ(problems.size(), 1U) << problems.front().text();
  EXPECT_EQ(problems[0].key, key);
  EXPECT_THAT(problems[0].message, HasSubstr(message));
}

TEST(FormerNames, AreRefusedWithTheNewOne) {
  const std::string right = right_scene;
  expect_only(right +
                  "[[packing]]\nkind = \"random\"\nwidth = \"1 m\"\n"
                  "height = \"1 m\"\n[[packing.class]]\nparticle = \"grain\"\nnumber = 2\n"
                  "distribution = \"uniform\"\nleast = \"8 mm\"\nmaximum = \"10 mm\"\n",
              "packing[1].class[0].least", "is called 'minimum' now, allowed: minimum");
  expect_only(right + "[[tool]]\nname = \"third\"\nshape = \"grip\"\n", "tool[2].shape",
              "'grip' is called 'constraint' now");
  expect_only(
      std::string(beam_with_tip) + inclined_plane(0, 0.1) + press_and_scan(4) + "back = \"no\"\n",
      "action[1].back", "is called 'retrace' now, allowed: retrace");
}

}  // namespace
}  // namespace pulvis
