// Moves behind a spring, and friction that depends on speed, are refused where they mean nothing.
#include <gmock/gmock.h>

#include "scenes/read.hpp"
#include "tests/helpers/paths.hpp"
#include "tests/helpers/wrong.hpp"

namespace pulvis {
namespace {

using testing::AllOf;
using testing::HasSubstr;

// One message for one mistake.
MATCHER(IsOneLine, "") { return arg.find('\n') == std::string::npos; }

// The second stage of shear/flat-16, whose target moves rigidly, or of shear/stick-slip, with other moves and servos: what
// is given for a tool is added to its move.
std::string rigid_refusal(const std::string& move) {
  const std::string text =
      "extends = \"shear/flat-16.toml\"\n[[stage]]\nname = \"shear\"\nmove = [" + move + "]\n";
  return message_of([&] { load_scene_text(text, paths::source_dir() + "/scenes/wrong.toml"); });
}
std::string drive_refusal(const std::string& stage, const std::string& more = "") {
  const std::string text = "extends = \"shear/stick-slip.toml\"\nremove = [\"expect\"]\n" + more +
                           "[[stage]]\nname = \"draw\"\n" + stage + "\n";
  return message_of([&] { load_scene_text(text, paths::source_dir() + "/scenes/wrong.toml"); });
}

const std::string spring = "stiffness = \"1 MN/m\", mass = \"10 g\"";

TEST(WrongDrives, AreRefused) {
  const auto move = [](const std::string& rest, const char* displacement = "\"1 mm\", \"0 mm\"") {
    return std::string("{ tool = \"target\", displacement = [") + displacement + "], " + rest +
           " }";
  };
  EXPECT_EQ(drive_refusal("move = [" + move(spring) + "]"), "");
  EXPECT_EQ(rigid_refusal(move(spring)), "");
  EXPECT_THAT(rigid_refusal(move("stiffness = \"1 MN/m\"")), HasSubstr("mass"));
  EXPECT_THAT(rigid_refusal(move("damping = 0.1")), HasSubstr("stiffness"));
  EXPECT_THAT(
      drive_refusal("move = [" + move(spring, "\"0 mm\", \"0 mm\"") + "]"),
      AllOf(HasSubstr("stage[1].move[0].displacement: a move by zero has no effect"), IsOneLine()));
  EXPECT_THAT(drive_refusal("move = [" + move(spring) + ", " + move("ramp = 0.1") + "]"),
              AllOf(HasSubstr("'target' is moved twice in this stage, allowed: one"), IsOneLine()));
  EXPECT_THAT(
      drive_refusal("move = [" + move(spring) +
                    "]\nservo = [{ tool = \"target\", force = \"1 N\" }]"),
      AllOf(HasSubstr("'target' has a servo in the same stage, allowed: only one of the two"),
            IsOneLine()));
  EXPECT_THAT(drive_refusal("",
                            "friction = [{ between = [\"steel\", \"target\"], coefficient = "
                            "0.2, rate = 0.1 }]\n"),
              HasSubstr("reference_speed"));
}

}  // namespace
}  // namespace pulvis
