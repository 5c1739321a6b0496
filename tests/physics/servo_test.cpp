// Servos over what they are pressed against: scenes in which a tool once swung up, and a law for a solid block
// at constant lateral stress. (What is shown for every stiffness, damping and step: servo_kernel_test.cpp.)
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numbers>

#include "tests/helpers/experiment.hpp"

namespace pulvis {
namespace {

const std::string metal = R"(family = "compaction"
title = "servo"
thickness = "1 mm"
[[material]]
name = "m"
density = "7990 kg/m^3"
youngs_modulus = "200 GPa"
poissons_ratio = 0.3
)";
const std::string flows = "yield_stress = \"240 MPa\"\nhardening_modulus = \"440 MPa\"\n";

const std::string disc =
    "[[particle]]\nname = \"p\"\nmaterial = \"m\"\noutline = \"disc\"\ndiameter = \"10 mm\"\n"
    "[particle.mesh]\nboundary_edges = 40\nrings = 1\n";
const std::string rounded =
    "[[particle]]\nname = \"p\"\nmaterial = \"m\"\noutline = \"rounded_rectangle\"\n"
    "width = \"11.39 mm\"\nheight = \"7.59 mm\"\nradius = \"3.04 mm\"\n";
const std::string flat =
    "[[particle]]\nname = \"p\"\nmaterial = \"m\"\noutline = \"rectangle\"\nwidth = \"20 mm\"\n"
    "height = \"5 mm\"\n[particle.mesh]\ncolumns = 16\nrows = 4\n";

std::string body(double x, double y) {
  return fmt::format("[[body]]\nparticle = \"p\"\nposition = [\"{} mm\", \"{} mm\"]\n", x, y);
}
std::string square(int count) {
  return fmt::format(
      "[[packing]]\nkind = \"square\"\nparticle = \"p\"\nrows = {0}\ncolumns = {0}\n", count);
}
std::string die(double width, double height) {  // mm
  const auto plane = [](const char* name, double x, double y, int nx, int ny) {
    return fmt::format(
        "[[tool]]\nname = \"{}\"\nshape = \"plane\"\npoint = [\"{} mm\", \"{} mm\"]\nnormal = [{}, "
        "{}]\n",
        name, x, y, nx, ny);
  };
  return plane("left", 0, 0, 1, 0) + plane("right", width, 0, -1, 0) + plane("bottom", 0, 0, 0, 1) +
         plane("top", 0, height, 0, -1);
}
std::string stage(const char* name, const char* kind, double duration) {  // ms
  return fmt::format("[[stage]]\nname = \"{}\"\nkind = \"{}\"\nduration = \"{} ms\"\n", name, kind,
                     duration);
}
std::string servo(const char* tool, double force, double rise) {
  return fmt::format(
      "[[stage.servo]]\ntool = \"{}\"\nforce = \"{} N\"\nrise = {}\ntolerance = 1e9\n", tool, force,
      rise);
}
std::string contact(double stiffness, double damping) {
  return fmt::format("[contact]\nfriction = 0.1\nstiffness = {}\ndamping = {}\n", stiffness,
                     damping);
}

// ---- what once swung up -----------------------------------------------------------------------------------
struct Case {
  const char* name;
  std::string powder;
  double width, height;       // mm, of the die
  double force;               // N
  double stiffness, damping;  // of the contact
  double load;                // ms
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

class ServoOver : public ::testing::TestWithParam<Case> {};

// The force is held to 0.2% from a quarter of the hold on, it is not passed by more than 1%, and no energy comes
// from nowhere. With the servo of before: energy off by 0.15 (nine discs) to 150 (block), forces by 20 to 90%.
TEST_P(ServoOver, HoldsItsForceAndKeepsItsEnergy) {
  const Case& c = GetParam();
  const double hold = 0.5 * c.load;
  Experiment e(own_scene(c.powder + die(c.width, c.height) + stage("load", "compact", c.load) +
                         servo("top", c.force, 0.8) + stage("hold", "hold", hold) +
                         servo("top", c.force, 0.2) + contact(c.stiffness, c.damping)));
  double maximum = 0, off = 0;
  e.run(300, [&] {
    const double force = e.value("tool/top/force_y");
    maximum = std::max(maximum, force);
    if (e.simulation.clock().time > (c.load + 0.25 * hold) * 1e-3)
      off = std::max(off, std::abs(force - c.force));
  });
  EXPECT_LT(e.results.energy_balance_error(), 5e-3);
  EXPECT_LT(maximum, 1.01 * c.force);
  EXPECT_LT(off, 2e-3 * c.force);
}

INSTANTIATE_TEST_SUITE_P(
    What, ServoOver,
    ::testing::Values(
        Case{"ADiscAndMuchDamping", metal + flows + disc + square(1), 10, 10, 4600, 0.5, 0.3, 0.4},
        Case{"ADiscAndStiffContacts", metal + flows + disc + square(1), 10, 10, 4000, 10, 0.1, 0.4},
        Case{"NineDiscsAndStiffContacts", metal + flows + disc + square(3), 30, 30, 5000, 10, 0.2,
             1},
        Case{"RoundedSquares", metal + flows + rounded + body(5.695, 3.795) + body(5.695, 11.385),
             11.39, 15.18, 3000, 4, 0.1, 0.4},
        Case{"AFlatBlock", metal + flat + body(10, 2.5), 20, 5, 4000, 0.5, 0.1, 0.4}),
    [](const auto& test) { return std::string(test.param.name); });

// A stage that ends at a density does so while the force still rises; that is no failure to hold it.
TEST(Servo, MayBeEndedBeforeItsForceIsReached) {
  Experiment e(own_scene(metal + flows + disc + square(1) + die(10, 10) +
                         stage("press", "compact", 1) + "[stage.until]\nrelative_density = 0.8\n" +
                         "[[stage.servo]]\ntool = \"top\"\nforce = \"20 kN\"\nrise = 1\n" +
                         stage("hold", "hold", 0.1) + contact(1, 0.1)));
  double maximum = 0;
  e.run(100, [&] { maximum = std::max(maximum, e.value("tool/top/force_y")); });
  EXPECT_GT(maximum, 500);
  EXPECT_LT(maximum, 10000);
  EXPECT_NEAR(e.value("relative_density"), 0.8, 0.002);
}

// What a servo adds while another tool comes to rest is counted, and what the spring of a drive takes up.
TEST(Servo, LetsAStageEndAtItsDensityBesideAMove) {
  const auto density = [](const std::string& drive) {
    Experiment e(own_scene(metal + flows + disc + square(1) + die(10, 10) +
                           stage("press", "compact", 1) +
                           "[stage.until]\nrelative_density = 0.84\n" + drive +
                           stage("hold", "hold", 0.05) + contact(1, 0.1)));
    e.run(100);
    return e.value("relative_density");
  };
  const std::string move =
      "[[stage.move]]\ntool = \"bottom\"\ndisplacement = [\"0 mm\", \"1.5 mm\"]\n";
  EXPECT_NEAR(density(move), 0.84, 1e-4);
  // What the servo adds can only be estimated: its speed changes while the other tool slows down.
  EXPECT_NEAR(density(move + servo("top", 3000, 0.6)), 0.84, 0.01);
  EXPECT_NEAR(density(move + "stiffness = \"2e7 N/m\"\nmass = \"5 g\"\ndamping = 0.5\n"), 0.84,
              0.002);
}

// ---- a law ------------------------------------------------------------------------------------------------
// A block that flows under plane strain without hardening bears 2/sqrt(3) of its yield stress more along its axis
// than from the side, where the servo keeps 1 kN on a height that shrinks. When all of it yields at once, the wall
// has to run a quarter of a metre per second faster within microseconds; the force falls by what moves with it.
TEST(Servo, KeepsTheLateralForceOfABiaxialTestOnABlock) {
  const std::string block =
      "[[particle]]\nname = \"p\"\nmaterial = \"m\"\noutline = \"rectangle\"\nwidth = \"10 mm\"\n"
      "height = \"10 mm\"\n[particle.mesh]\ncolumns = 8\nrows = 8\n";
  Experiment e(own_scene(metal + "yield_stress = \"240 MPa\"\n" + block + body(5, 5) + die(10, 10) +
                         stage("confine", "compact", 0.1) + servo("right", 1000, 0.5) +
                         servo("top", 1000, 0.5) + stage("press", "compact", 1) +
                         "[[stage.move]]\ntool = \"top\"\ndisplacement = [\"0 mm\", \"-0.5 mm\"]\n"
                         "ramp = 0.3\n" +
                         servo("right", 1000, 0.2) +
                         "[contact]\nfriction = 0\ndamping = 0.1\nstiffness = 0.5\n"));
  double off = 0, off_at_yield = 0;
  e.run(400, [&] {
    const double time = e.simulation.clock().time * 1e3;
    const bool first_yield = time > 0.1 && time < 0.4;
    double& worst = first_yield ? off_at_yield : off;
    if (time > 0.075 && time < 0.8)  // approached by then; at the end the punch comes to rest
      worst = std::max(worst, std::abs(e.value("tool/right/force_x") - 1000));
  });
  EXPECT_LT(off, 1.0);
  EXPECT_LT(off_at_yield, 50);
  const double high = e.value("tool/top/position_y"), wide = e.value("tool/right/position_x");
  const double axial = e.value("tool/top/force_y") / (wide * 1e-3), side = 1000 / (high * 1e-3);
  EXPECT_NEAR((axial - side) / 240e6, 2 / std::numbers::sqrt3, 0.01);
}

// Contact dashpots answer half a step late; the step has to be short enough for them. They once fed a block that
// is pressed by a punch on its way with up to 80 times the work of the punch.
class Damped : public ::testing::TestWithParam<double> {};
TEST_P(Damped, ContactsTakeEnergyAway) {
  Experiment e(own_scene(
      metal + flat + body(10, 2.5) + body(10, 7.5) + die(20, 10) + stage("press", "compact", 0.05) +
      "[[stage.move]]\ntool = \"top\"\ndisplacement = [\"0 mm\", \"-0.05 mm\"]\n" +
      stage("hold", "hold", 0.05) + contact(GetParam(), 1)));
  e.run(100);
  EXPECT_LT(e.results.energy_balance_error(), 1e-4);
}
INSTANTIATE_TEST_SUITE_P(Stiffness, Damped, ::testing::Values(0.5, 10));

}  // namespace
}  // namespace pulvis
