// What `check` and `run` say of stages too short for their servos.
#include "scenes/checks/servo_warnings.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/helpers/experiment.hpp"

namespace pulvis {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

std::vector<std::string> lines_of(const Scene& scene) {
  Simulation simulation(scene);
  return servo_warnings(scene, simulation.world());
}

constexpr const char* steel =
    "family = \"compaction\"\n[[material]]\nname = \"m\"\ndensity = \"7990 kg/m^3\"\n"
    "youngs_modulus = \"200 GPa\"\npoissons_ratio = 0.3\n";

std::string servo_of(const char* force) {
  return fmt::format("[[stage.servo]]\ntool = \"top\"\nforce = \"{}\"\n", force);
}

// A block of 10 mm x 10 mm between plates: it counts as a disc of its area, 11.28 mm wide, so that a passage takes
// 8.86 mm at 5805 m/s: 1.53 us.
class BlockUnderAServo {
 public:
  double gap = 0;  // mm, above the block and above a second one
  int blocks = 1;
  std::string more;  // of the stage
  std::string stages;

  std::vector<std::string> lines(double duration) const {
    std::string text =
        std::string(steel) +
        "[[particle]]\nname = \"p\"\nmaterial = \"m\"\noutline = \"rectangle\"\n"
        "width = \"10 mm\"\nheight = \"10 mm\"\n[particle.mesh]\ncolumns = 2\nrows = 2\n";
    for (int i = 0; i < blocks; ++i)
      text += fmt::format("[[body]]\nparticle = \"p\"\nposition = [\"0 mm\", \"{} mm\"]\n",
                          5 + i * (10 + gap));
    text +=
        "[[tool]]\nname = \"bottom\"\nshape = \"plane\"\npoint = [\"0 mm\", \"0 mm\"]\nnormal = "
        "[0, 1]\n";
    text += fmt::format(
        "[[tool]]\nname = \"top\"\nshape = \"plane\"\npoint = [\"0 mm\", \"{} mm\"]\nnormal = [0, "
        "-1]\n",
        blocks * (10 + gap));
    text += fmt::format("[[stage]]\nname = \"press\"\nkind = \"compact\"\nduration = \"{} us\"\n",
                        duration);
    return lines_of(own_scene("thickness = \"10 mm\"\n" + text + servo_of("1 kN") + more + stages));
  }
};

TEST(ServoWarnings, AStageOfFewPassagesOfAWaveIsTold) {
  BlockUnderAServo block;
  EXPECT_THAT(block.lines(60),
              ElementsAre(AllOf(HasSubstr("stage 'press': tool 'top' may not reach 1000 N: the "
                                          "stage lasts 39.3 passages of an elastic wave through "
                                          "the powder, 1.5e-06 s each"),
                                HasSubstr("use a longer stage: at least 7.6e-05 s"),
                                Not(HasSubstr("gaps")))));
  EXPECT_THAT(block.lines(80), IsEmpty());
}

// 2 F/Z = 2 x 1000 N/(46.4e6 kg/m^2/s x 11.28 mm x 10 mm) = 0.38 m/s.
TEST(ServoWarnings, GapsThatCloseFirstAreCounted) {
  BlockUnderAServo block;
  block.gap = 0.1;
  EXPECT_THAT(block.lines(330),
              ElementsAre(AllOf(HasSubstr("gaps of 0.0001 m in all have to close "
                                          "first, at up to 0.38 m/s in 0.00026 s"),
                                HasSubstr("at least 0.00034 s"))));
  EXPECT_THAT(block.lines(350), IsEmpty());
  block.blocks = 2;
  EXPECT_THAT(block.lines(350), ElementsAre(HasSubstr("gaps of 0.0002 m")));
  block.more = "max_speed = \"0.1 m/s\"\n";
  EXPECT_THAT(block.lines(1500), ElementsAre(HasSubstr("at up to 0.1 m/s in 0.002 s")));
}

TEST(ServoWarnings, AForceThatIsKeptOrNotAskedForNeedsNoApproach) {
  const auto second = [](const char* force, const char* more = "") {
    return std::string("[[stage]]\nname = \"more\"\nkind = \"hold\"\nduration = \"20 us\"\n") +
           servo_of(force) + more;
  };
  BlockUnderAServo block;
  block.stages = second("1 kN");
  EXPECT_THAT(block.lines(80), IsEmpty());
  block.stages = second("0.5 kN");
  EXPECT_THAT(block.lines(80), IsEmpty());
  block.stages = second("2 kN");
  EXPECT_THAT(block.lines(80), ElementsAre(HasSubstr("stage 'more': tool 'top' may not reach")));
  block.stages = second("2 kN", "tolerance = 1e6\n");
  EXPECT_THAT(block.lines(80), IsEmpty());
  block.stages = second("2 kN", "[stage.until]\ntool = \"top\"\nforce = \"1.5 kN\"\n");
  EXPECT_THAT(block.lines(80), IsEmpty());
}

// A sphere's mass over its section is that of two thirds of its diameter: 1.15 us. Gaps of 0.5 mm below it and 1.5 mm above, less
// what the corners of the mesh stand out.
TEST(ServoWarnings, HoldInThreeDimensions) {
  const auto lines = [](double duration, double gap) {
    return lines_of(own_scene(
        "dimension = 3\n" + std::string(steel) +
        "[[particle]]\nname = \"p\"\nmaterial = \"m\"\nshape = \"sphere\"\ndiameter = \"10 mm\"\n"
        "[particle.mesh]\ndivisions = 8\nrings = 1\n[[body]]\nparticle = \"p\"\nposition = [\"0 "
        "mm\", \"0 mm\", \"5 mm\"]\n"
        "[[tool]]\nname = \"bottom\"\nshape = \"plane\"\npoint = [\"0 mm\", \"0 mm\", \"-0.5 "
        "mm\"]\nnormal = [0, 0, 1]\n" +
        fmt::format("[[tool]]\nname = \"top\"\nshape = \"plane\"\npoint = [\"0 mm\", \"0 mm\", "
                    "\"{} mm\"]\nnormal = [0, 0, -1]\n[[stage]]\nname = \"press\"\nkind = "
                    "\"compact\"\nduration = \"{} us\"\n",
                    10.5 + gap, duration) +
        servo_of("10 kN")));
  };
  EXPECT_THAT(lines(40, 1), ElementsAre(HasSubstr("the stage lasts 3")));
  EXPECT_THAT(lines(40, 1), ElementsAre(HasSubstr("gaps of 0.0019")));
  EXPECT_THAT(lines(2000, 1), IsEmpty());
}

TEST(ServoWarnings, StressesOfACellAreTold) {
  const auto lines = [](const char* duration) {
    return lines_of(read_scene(paths::source_dir() + "/scenes/periodic/shear.toml",
                               {std::string("stage[0].duration=") + duration}));
  };
  EXPECT_THAT(lines("50 us"), ElementsAre(AllOf(HasSubstr("stresses may not be reached"),
                                                HasSubstr("use a longer stage: at least"))));
  EXPECT_THAT(lines("5 ms"), IsEmpty());
}

}  // namespace
}  // namespace pulvis
