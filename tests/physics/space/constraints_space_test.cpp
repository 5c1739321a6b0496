// Constraints in three dimensions against closed forms: a cube drawn, sheared and carried along.
#include <gtest/gtest.h>

#include <cmath>

#include "components/body.hpp"
#include "components/surface.hpp"
#include "tests/helpers/experiment.hpp"

namespace pulvis {
namespace {

constexpr double youngs = 200e9, poisson = 0.3, side = 10e-3;

// A steel cube with corners at 0 and 10 mm. `then`: its constraints and stages.
std::string held_cube(const std::string& then) {
  return R"(
family = "compaction"
dimension = 3
[[material]]
name = "steel"
density = "7850 kg/m^3"
youngs_modulus = "200 GPa"
poissons_ratio = 0.3
[material.damping]
mass_proportional = "3e5 1/s"
[[particle]]
name = "cube"
material = "steel"
shape = "polyhedron"
corners = [["-5 mm", "-5 mm", "-5 mm"], ["5 mm", "-5 mm", "-5 mm"], ["-5 mm", "5 mm", "-5 mm"], ["5 mm", "5 mm", "-5 mm"], ["-5 mm", "-5 mm", "5 mm"], ["5 mm", "-5 mm", "5 mm"], ["-5 mm", "5 mm", "5 mm"], ["5 mm", "5 mm", "5 mm"]]
rounding = "0 mm"
mesh = { divisions = 2, rings = 1 }
[[body]]
particle = "cube"
position = ["5 mm", "5 mm", "5 mm"]
)" + then;
}
// Holds the nodes between two heights.
std::string constraint(const std::string& name, const std::string& holds, const std::string& low,
                       const std::string& high) {
  return "[[tool]]\nname = \"" + name +
         "\"\nshape = \"constraint\"\nlow = [\"0 mm\", \"0 mm\", \"" + low +
         " mm\"]\nhigh = [\"10 mm\", \"10 mm\", \"" + high + " mm\"]\nholds = \"" + holds + "\"\n";
}
std::string stage(const std::string& name, const std::string& moves, const std::string& keys = "") {
  return "[[stage]]\nname = \"" + name + "\"\nkind = \"compact\"\nduration = \"40 us\"\n" + keys +
         moves;
}
std::string move(const std::string& tool, const std::string& displacement) {
  return "[[stage.move]]\ntool = \"" + tool + "\"\ndisplacement = " + displacement +
         "\nramp = 0.5\n";
}
const std::string rest = "[[stage]]\nname = \"rest\"\nkind = \"hold\"\nduration = \"40 us\"\n";
const std::string formulations[] = {"", "[element]\nformulation = \"eight-point\"\n"};

// Free sides: uniaxial stress.
TEST(SpaceConstraint, CubeIsDrawnAsYoungsModulusSays) {
  for (const std::string& formulation : formulations) {
    Experiment e(own_scene(held_cube(
        constraint("low", "z", "0", "0") + constraint("high", "z", "10", "10") +
        stage("draw", move("high", "[\"0 mm\", \"0 mm\", \"0.001 mm\"]")) + rest + formulation)));
    e.run(40);
    const double wanted = youngs * side * side * 1e-6 / side;
    EXPECT_NEAR(e.value("tool/low/force_z") / wanted, 1, 1e-3);
    EXPECT_NEAR(e.value("tool/high/force_z") / -wanted, 1, 1e-3);
    EXPECT_EQ(e.value("tool/high/force_x"), 0);
    EXPECT_NEAR(e.value("tool/high/position_z"), 10.001e-3, 1e-15);
    EXPECT_NEAR(e.results.energies().elastic / (0.5 * wanted * 1e-6), 1, 2e-3);
    EXPECT_LT(e.results.energy_balance_error(), 1e-3);
    // Poisson's contraction of the free sides.
    const auto& x = e.column<Position<ThreeD>>();
    double low = 1, high = 0;
    for (std::size_t n = 0; n < x.table.rows; ++n) {
      low = std::min(low, x.lanes()[3 * n][0]);
      high = std::max(high, x.lanes()[3 * n][0]);
    }
    EXPECT_NEAR((high - low) / side - 1, -poisson * 1e-4, 1e-7);
  }
}

// All nodes stay in their planes, and the sides are free along x: simple shear.
TEST(SpaceConstraint, CubeIsShearedAsTheShearModulusSays) {
  for (const std::string& formulation : formulations) {
    Experiment e(own_scene(held_cube(
        constraint("low", "x", "0", "0") + constraint("high", "x", "10", "10") +
        constraint("across", "y", "0", "10") + constraint("level", "z", "0", "10") +
        stage("shear", move("high", "[\"0.001 mm\", \"0 mm\", \"0 mm\"]")) + rest + formulation)));
    e.run(40);
    const double wanted = youngs / (2 * (1 + poisson)) * side * side * 1e-6 / side;
    EXPECT_NEAR(e.value("tool/low/force_x") / wanted, 1, 1e-3);
    EXPECT_NEAR(e.value("tool/high/force_x") / -wanted, 1, 1e-3);
    EXPECT_NEAR(e.value("tool/across/force_y") / wanted, 0, 1e-3);
    EXPECT_NEAR(e.value("tool/level/force_z") / wanted, 0, 1e-3);
    EXPECT_LT(e.results.energy_balance_error(), 1e-3);
  }
}

// The force on a body that is carried along is its mass times the acceleration; it has no stress. A half ramp accelerates
// and brakes all the time: sampled while it moves.
TEST(SpaceConstraint, CarriesABodyWithoutStress) {
  Experiment e(
      own_scene(held_cube(constraint("all", "all", "0", "10") +
                          stage("carry", move("all", "[\"1 mm\", \"-2 mm\", \"3 mm\"]")))));
  const auto& x = e.column<Position<ThreeD>>();
  e.run(20, [&] {
    EXPECT_LT(e.results.energies().elastic, 1e-9 * e.results.energies().kinetic + 1e-12);
    const double travel = e.value("tool/all/position_x") - 5e-3;
    double left = 1;
    for (std::size_t n = 0; n < x.table.rows; ++n) left = std::min(left, x.lanes()[3 * n][0]);
    EXPECT_NEAR(left, travel, 1e-15);
  });
  EXPECT_NEAR(e.value("tool/all/position_z"), 8e-3, 1e-14);
  EXPECT_LT(e.results.energy_balance_error(), 1e-3);
}

// Nodes move away from the point; the work of the radial force is the energy.
TEST(SpaceConstraint, NodesMoveRadially) {
  Experiment e(own_scene(held_cube(
      "[[tool]]\nname = \"spread\"\nshape = \"constraint\"\nlow = [\"10 mm\", \"0 mm\", \"0 "
      "mm\"]\nhigh = [\"10 mm\", \"10 mm\", \"10 mm\"]\nholds = \"radial\"\npoint = [\"5 "
      "mm\", \"5 mm\", \"5 mm\"]\n" +
      stage("spread", move("spread", "[\"0.001 mm\", \"0 mm\", \"0 mm\"]")))));
  const auto& x = e.column<Position<ThreeD>>();
  std::vector<std::pair<std::size_t, double>> held;  // node, distance
  const auto distance = [&](std::size_t n) {
    const auto at = [&](std::size_t k) { return x.lanes()[3 * n + k][0] - 5e-3; };
    return std::hypot(at(0), at(1), at(2));
  };
  for (std::size_t n = 0; n < x.table.rows; ++n)
    if (std::abs(x.lanes()[3 * n][0] - 10e-3) < 1e-9) held.emplace_back(n, distance(n));
  ASSERT_EQ(held.size(), 9U);
  e.run(40);
  EXPECT_LT(e.value("tool/spread/force_x"), -1);
  EXPECT_EQ(e.value("tool/spread/force_y"), 0);
  EXPECT_EQ(e.value("tool/spread/force_z"), 0);
  EXPECT_LT(e.results.energy_balance_error(), 1e-3);
  // Along the radius by the displacement; free across it, by as much as the cube needs.
  for (const auto& [n, before] : held) EXPECT_NEAR(distance(n), before + 1e-6, 1e-9);
}

// A ball held in the middle bears the force of a plane: action and reaction.
TEST(SpaceConstraint, BearsWhatAPlanePresses) {
  Experiment e(own_scene(R"(
family = "compaction"
dimension = 3
material = [{ name = "steel", density = "7990 kg/m^3", youngs_modulus = "200 GPa", poissons_ratio = 0.3, damping = { mass_proportional = "1e6 1/s" } }]
particle = [{ name = "ball", material = "steel", shape = "sphere", diameter = "10 mm", mesh = { divisions = 3, rings = 2 } }]
body = [{ particle = "ball", position = ["0 mm", "0 mm", "5 mm"] }]
tool = [
  { name = "holder", shape = "constraint", point = ["0 mm", "0 mm", "5 mm"], radius = "2 mm", holds = "all" },
  { name = "floor", shape = "plane", point = ["0 mm", "0 mm", "0 mm"], normal = [0, 0, 1] },
]
[[stage]]
name = "lower"
kind = "compact"
duration = "30 us"
move = [{ tool = "holder", displacement = ["0 mm", "0 mm", "-0.05 mm"], ramp = 0.5 }]
[[stage]]
name = "rest"
kind = "hold"
duration = "30 us"
)"));
  e.run(30);
  EXPECT_LT(e.value("tool/floor/force_z"), -100);
  EXPECT_NEAR(e.value("tool/floor/force_z") / -e.value("tool/holder/force_z"), 1, 1e-3);
  EXPECT_GT(e.value("contact_overlap"), 0);
  EXPECT_LT(e.results.energy_balance_error(), 5e-3);
}

TEST(SpaceConstraint, ExistsOnlyWhereAsked) {
  Experiment with(own_scene(held_cube(constraint("low", "z", "0", "0") + rest)));
  EXPECT_TRUE(with.simulation.world().has<ConstraintReaction>());
  EXPECT_FALSE(with.simulation.world().has<ContactPair<FaceToolContact>>());
  Experiment without("compaction-3d/one-sphere.toml");
  EXPECT_FALSE(without.simulation.world().has<ConstraintReaction>());
}

}  // namespace
}  // namespace pulvis
