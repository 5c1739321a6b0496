// A die's powder that another run has pressed: tools, forces and sums go on from there, in both dimensions.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "systems/time_step_limit.hpp"
#include "tests/helpers/initial_state.hpp"

namespace pulvis {
namespace {

struct Die {
  const char* name;
  std::string powder, press, hold, draw;  // the press keeps its state; the others follow it
  const char *force, *position;           // series of the top
};

// A state has no indentations: nothing indents.
const std::string copper = R"(
[[material]]
name = "Cu"
density = "8940 kg/m^3"
youngs_modulus = "115 GPa"
poissons_ratio = 0.35
yield_stress = "50 MPa"
hardening_modulus = "440 MPa"
[contact]
hardness = 1000
friction = 0.1
damping = 0.2
[die]
[[particle]]
name = "grain"
material = "Cu"
diameter = "1 mm"
)";

std::string moved_by(const std::string& kind, const std::string& displacement,
                     const std::string& keys = "") {
  return "[[stage]]\nname = \"" + kind + "\"\nkind = \"" + kind + "\"\nduration = \"15 us\"\n" +
         keys + "[[stage.move]]\ntool = \"top\"\ndisplacement = " + displacement + "\n";
}
std::string held_at(const std::string& force) {
  return "[[stage]]\nname = \"hold\"\nkind = \"hold\"\nduration = \"15 us\"\n[[stage.servo]]\ntool "
         "= "
         "\"top\"\nforce = \"" +
         force + "\"\ntolerance = 1\n";
}

const std::array dies{
    Die{"plane",
        "family = \"compaction\"\n" + copper +
            "outline = \"disc\"\nmesh = { boundary_edges = 20 }\n[[packing]]\nkind = \"square\"\n"
            "particle = \"grain\"\nrows = 3\ncolumns = 2\n",
        moved_by("compact", "[\"0 mm\", \"-0.15 mm\"]", "keep_state = true\n"), held_at("100 N"),
        moved_by("unload", "[\"0 mm\", \"0.05 mm\"]"), "tool/top/force_y", "tool/top/position_y"},
    Die{"space",
        "family = \"compaction\"\ndimension = 3\n" + copper +
            "shape = \"sphere\"\nmesh = { divisions = 2, rings = 1 }\n[[packing]]\nkind = "
            "\"cubic\"\nparticle = \"grain\"\ncells = [1, 1, 3]\n",
        moved_by("compact", "[\"0 mm\", \"0 mm\", \"-0.15 mm\"]", "keep_state = true\n"),
        held_at("100 N"), moved_by("unload", "[\"0 mm\", \"0 mm\", \"0.05 mm\"]"),
        "tool/top/force_z", "tool/top/position_z"}};

class DieState : public InitialState, public testing::WithParamInterface<std::size_t> {
 protected:
  const Die& die() const { return dies[GetParam()]; }

  // Of one run through two stages, and of another that begins with the state between them.
  void expect_as_in_one_run(const std::string& second) {
    Experiment whole(own_scene(die().powder + die().press + second));
    whole.run(20);
    kept(die().powder, die().press);
    Experiment rest = gone_on(die().powder, second);
    EXPECT_EQ(rest.simulation.clock().time, 0);
    rest.run(10);
    EXPECT_NEAR(rest.value(die().position) / whole.value(die().position), 1, 1e-6);
    EXPECT_NEAR(rest.value("relative_density") / whole.value("relative_density"), 1, 1e-6);
    EXPECT_NEAR(rest.value("energy/plastic") / whole.value("energy/plastic"), 1, 1e-4);
    EXPECT_NEAR(rest.value(die().force), whole.value(die().force),
                1e-3 * std::abs(whole.value(die().force)) + 1e-3);
    EXPECT_LT(rest.results.energy_balance_error(), 0.005);
  }
};

TEST_P(DieState, GoesOnUnderMoves) { expect_as_in_one_run(die().draw); }

// The run that keeps the state has no servo, the one that begins with it has.
TEST_P(DieState, GoesOnUnderAServo) {
  kept(die().powder, die().press);
  Experiment rest = gone_on(die().powder, die().hold);
  rest.run(10);
  Experiment whole(own_scene(die().powder + die().press + die().hold));
  whole.run(20);
  EXPECT_NEAR(rest.value(die().position) / whole.value(die().position), 1, 1e-3);
  EXPECT_NEAR(rest.value(die().force) / whole.value(die().force), 1, 0.05);
}

// The estimate of the highest mode that the state brings is for a run without a servo.
TEST_P(DieState, TakesStepsForItsOwnServo) {
  const auto stable = [](Experiment&& e) {
    e.simulation.observe();
    return shortest_stable_step(e.simulation.world());
  };
  kept(die().powder, die().press);
  const double from_state =
      stable(gone_on(die().powder, die().hold)) / stable(gone_on(die().powder, die().draw));
  const double afresh = stable(Experiment(own_scene(die().powder + die().hold))) /
                        stable(Experiment(own_scene(die().powder + die().press)));
  EXPECT_NEAR(from_state / afresh, 1, 0.03);
  EXPECT_LT(afresh, 0.95) << from_state;
}

using PlaneState = InitialState;

// The walls of the first run are driven by strains of the die, those of the second by moves.
TEST_F(PlaneState, OfDrivenWallsGoesOnUnderMoves) {
  const std::string driven =
      "[[stage]]\nname = \"press\"\nkind = \"compact\"\nduration = \"15 us\"\nkeep_state = "
      "true\ncell = { strain_xx = -0.03, strain_yy = -0.05 }\n";
  const auto before = kept(dies[0].powder, driven);
  const double top = before->value("tool/top/position_y"),
               right = before->value("tool/right/position_x");
  Experiment rest = gone_on(dies[0].powder, dies[0].draw);
  rest.run(10);
  EXPECT_NEAR(rest.value("tool/top/position_y"), top + 0.05e-3, 1e-12);
  EXPECT_NEAR(rest.value("tool/right/position_x"), right, 1e-12);
  EXPECT_LT(rest.results.energy_balance_error(), 0.005);
}

const std::string steel_bar = R"(
[[material]]
name = "steel"
density = "7850 kg/m^3"
youngs_modulus = "200 GPa"
poissons_ratio = 0.3
[material.damping]
mass_proportional = "1e5 1/s"
[[particle]]
name = "bar"
material = "steel"
)";
const std::string plane_bar = "family = \"compaction\"\n" + steel_bar + R"(
outline = "rectangle"
width = "20 mm"
height = "5 mm"
mesh = { columns = 8, rows = 2 }
[[body]]
particle = "bar"
position = ["10 mm", "0 mm"]
[[tool]]
name = "left"
shape = "constraint"
low = ["0 mm", "-2.5 mm"]
high = ["0 mm", "2.5 mm"]
holds = "both"
[[tool]]
name = "right"
shape = "constraint"
low = ["20 mm", "-2.5 mm"]
high = ["20 mm", "2.5 mm"]
holds = "x"
)";
const std::string space_bar = "family = \"compaction\"\ndimension = 3\n" + steel_bar + R"(
shape = "cylinder"
diameter = "5 mm"
height = "20 mm"
rounding = "0 mm"
mesh = { grid = "extruded", divisions = 2, rings = 1, axial_divisions = 8 }
[[body]]
particle = "bar"
position = ["10 mm", "0 mm", "0 mm"]
angle = "90 deg"
axis = [0, 1, 0]
[[tool]]
name = "left"
shape = "constraint"
low = ["0 mm", "-2.5 mm", "-2.5 mm"]
high = ["0 mm", "2.5 mm", "2.5 mm"]
holds = "all"
[[tool]]
name = "right"
shape = "constraint"
low = ["20 mm", "-2.5 mm", "-2.5 mm"]
high = ["20 mm", "2.5 mm", "2.5 mm"]
holds = "x"
)";

// A bar that one run has drawn is drawn on by another.
class ConstraintState : public InitialState, public testing::WithParamInterface<bool> {};

TEST_P(ConstraintState, GoesOnFromWhereTheyAre) {
  const std::string& bar = GetParam() ? space_bar : plane_bar;
  const std::string along =
      GetParam() ? "[\"0.002 mm\", \"0 mm\", \"0 mm\"]" : "[\"0.002 mm\", \"0 mm\"]";
  const auto drawn = [&](const std::string& name, const std::string& keys = "") {
    return "[[stage]]\nname = \"" + name + "\"\nkind = \"compact\"\nduration = \"0.3 ms\"\n" +
           keys + "[[stage.move]]\ntool = \"right\"\ndisplacement = " + along + "\nramp = 0.5\n";
  };
  const std::string first = drawn("first", "keep_state = true\n"), second = drawn("second");
  Experiment whole(own_scene(bar + first + second));
  whole.run(20);
  kept(bar, first);
  Experiment rest = gone_on(bar, second);
  rest.run(10);
  for (const char* series : {"tool/right/position_x", "tool/right/force_x", "energy/elastic"})
    EXPECT_NEAR(rest.value(series) / whole.value(series), 1, 1e-3) << series;
  EXPECT_NEAR(rest.value("tool/right/position_x"), 20.004e-3, 1e-10);
  EXPECT_LT(rest.results.energy_balance_error(), 0.005);
}

INSTANTIATE_TEST_SUITE_P(In, ConstraintState, testing::Bool(),
                         [](const auto& of) { return std::string(of.param ? "space" : "plane"); });
INSTANTIATE_TEST_SUITE_P(In, DieState, testing::Range(std::size_t{0}, dies.size()),
                         [](const auto& of) { return dies[of.param].name; });

}  // namespace
}  // namespace pulvis
