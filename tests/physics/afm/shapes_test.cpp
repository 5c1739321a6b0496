// Tips and levers of every shape that can be declared: they stand where they should and answer by laws that
// hold for all of them.
#include <cmath>

#include "tests/helpers/lever.hpp"

namespace pulvis {
namespace {

std::string with_tip(const std::string& keys) {
  return tipless_beam() + "[tip]\nmaterial = \"stiff\"\n" + keys;
}

struct Tip {
  const char* name;
  const char* keys;
  double height;  // m, from the lever's lower face
};

const Tip tips[] = {
    {"block", "shape = \"block\"\nheight = \"10 um\"\nfoot = \"6 um\"\nset_back = \"10 um\"\n",
     10e-6},
    {"pyramid",
     "shape = \"pyramid\"\nheight = \"10 um\"\nfoot = \"6 um\"\nend = \"0.5 um\"\n"
     "set_back = \"10 um\"\n",
     10e-6},
    {"cone",
     "shape = \"cone\"\nheight = \"10 um\"\nfoot = \"6 um\"\nend = \"0.5 um\"\n"
     "set_back = \"10 um\"\n",
     10e-6},
    {"sphere",
     "shape = \"sphere\"\nradius = \"8 um\"\nneck_radius = \"3 um\"\nneck_height = \"2 um\"\n"
     "set_back = \"10 um\"\n",
     18e-6},
};

// Small answers obey the theorem of Maxwell and Betti, and a stiff tip turns with its foot.
TEST(AfmShapes, EveryTipStandsUnderTheLeverAndAnswersReciprocally) {
  for (const Tip& tip : tips) {
    const Calibration c = calibration_of(with_tip(tip.keys), {"tip.offset=7 um"});
    EXPECT_NEAR(c.arm, tip.height + 1.1e-6, 1e-12) << tip.name;
    EXPECT_NEAR(c.normal.end.y() / c.lateral.end.z(), 1, 1e-6) << tip.name;
    EXPECT_NEAR(c.normal.end.x() / c.longitudinal.end.z(), 1, 1e-6) << tip.name;
    EXPECT_LT(c.tip_share, 0.05) << tip.name;
    EXPECT_LT(c.imbalance, 1e-9) << tip.name;
    // A force that acts beside the axis twists by its moment; a lateral one turns the foot in its place, too.
    EXPECT_NEAR(c.normal.at_foot.lateral * c.torsional_stiffness / 7e-6, 0.97, 0.03) << tip.name;
  }
}

// The further from the end a probe stands the stiffer the lever is: by the cube of its distance.
TEST(AfmShapes, ABallSetBackPressesOnAShorterLever) {
  const std::string ball = with_tip(tips[3].keys);
  const double end = calibration_of(ball).normal_stiffness;
  const double back = calibration_of(ball, {"tip.set_back=60 um"}).normal_stiffness;
  EXPECT_NEAR(back / end / std::pow(430.0 / 380.0, 3), 1, 0.01);
}

constexpr const char* v_lever = R"(family = "afm"
[[material]]
name = "m"
youngs_modulus = "200 GPa"
poissons_ratio = 0.3
[lever]
shape = "v"
material = "m"
length = "115 um"
arm_width = "20 um"
thickness = "0.6 um"
[tip]
set_back = "8 um"
)";

TEST(AfmShapes, HalfAngleAndBaseWidthAreTwoWordsForTheSameV) {
  const double by_angle = calibration_of(v_lever, {"lever.half_angle=30 deg"}).normal_stiffness;
  const double width = 2 * 115e-6 * std::tan(std::acos(-1.0) / 6);
  const double by_width =
      calibration_of(v_lever, {"lever.base_width=" + std::to_string(width * 1e6) + " um"})
          .normal_stiffness;
  EXPECT_NEAR(by_width / by_angle, 1, 1e-5);
}

// An apex plate of a blunt V lies on the pointed one that reaches further: the same arms, the same load place.
TEST(AfmShapes, ABluntVIsAPointedOneWithoutItsPoint) {
  const double pointed = calibration_of(v_lever, {"lever.half_angle=30 deg"}).normal_stiffness;
  const double cut = 6e-6 * std::tan(std::acos(-1.0) / 6) * 2;  // width 6 um behind the point
  const double blunt =
      calibration_of(v_lever,
                     {"lever.half_angle=30 deg", "lever.length=109 um", "tip.set_back=2 um",
                      "lever.apex_width=" + std::to_string(cut * 1e6) + " um"})
          .normal_stiffness;
  EXPECT_NEAR(blunt / pointed, 1, 0.005);
}

}  // namespace
}  // namespace pulvis
