// The periodic cell against laws: it has no walls and no place, frames do not matter, what it bears is what its particles bear, and stresses are held.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "scenes/results/state_hash.hpp"
#include "tests/helpers/experiment.hpp"

namespace pulvis {
namespace {

// Without inerters: the steps of the highest mode differ in the last digits from frame to frame, and with them the ringing.
constexpr const char* steel = R"(
family = "compaction"
[[material]]
name = "316L"
density = "7990 kg/m^3"
youngs_modulus = "200 GPa"
poissons_ratio = 0.3
yield_stress = "240 MPa"
hardening_modulus = "440 MPa"
[[particle]]
name = "disc"
material = "316L"
outline = "disc"
diameter = "10 mm"
[particle.mesh]
boundary_edges = 40
rings = 1
[contact]
stiffness = 20
tangential_stiffness = 20
inertance = 0
)";

std::string body(double x, double y, double angle = 0) {
  return fmt::format(
      "[[body]]\nparticle = \"disc\"\nposition = [\"{:.17g} m\", \"{:.17g} m\"]\nangle = \"{:.17g} "
      "rad\"\n",
      x, y, angle);
}

std::string square(double angle) {
  const double c = std::cos(angle), s = std::sin(angle), strain = -std::log(1 / 0.9);
  return std::string(steel) + body(5e-3 * (c - s), 5e-3 * (s + c), angle) +
         fmt::format(R"([cell]
width = "10 mm"
height = "10 mm"
angle = "{:.17g} rad"
[[stage]]
name = "press"
kind = "compact"
duration = "1 ms"
[stage.cell]
strain_xx = {:.17g}
strain_yy = {:.17g}
strain_xy = {:.17g}
)",
                     angle, strain * s * s, strain * c * c, -strain * s * c);
}

struct PlaneStress {
  double xx, yy, xy;
};
PlaneStress stress(const Experiment& e, const std::string& name) {
  return {e.value(name + "xx"), e.value(name + "yy"), e.value(name + "xy")};
}

TEST(SquareCell, BearsWhatADiscBetweenFourPlanesBears) {
  Experiment cell(own_scene(square(0)));
  cell.run(10);
  std::string planes = std::string(steel) + body(5e-3, 5e-3);
  for (const auto& [name, x, y, nx, ny] : {std::tuple{"left", 0, 0, 1, 0},
                                           {"right", 10, 0, -1, 0},
                                           {"bottom", 0, 0, 0, 1},
                                           {"top", 0, 10, 0, -1}})
    planes += fmt::format(
        "[[tool]]\nname = \"{}\"\nshape = \"plane\"\npoint = [\"{} mm\", \"{} mm\"]\nnormal = [{}, "
        "{}]\n",
        name, x, y, nx, ny);
  Experiment die(own_scene(planes + R"([output]
particle_stress = true
[[stage]]
name = "press"
kind = "compact"
duration = "1 ms"
[[stage.move]]
tool = "top"
displacement = ["0 mm", "-1 mm"]
)"));
  die.run(10);
  const PlaneStress in_cell = stress(cell, "stress/"), in_die = stress(die, "stress/");
  EXPECT_NEAR(in_cell.xx / in_die.xx, 1, 0.005);
  EXPECT_NEAR(in_cell.yy / in_die.yy, 1, 0.005);
  EXPECT_NEAR(cell.value("stress/zz") / die.value("stress/zz"), 1, 0.005);
  EXPECT_NEAR(stress(cell, "cell/stress_").yy / in_cell.yy, 1, 0.005);
  EXPECT_NEAR(-die.value("stress/axial_top") / in_die.yy, 1, 0.005);
  EXPECT_NEAR(cell.value("relative_density"), die.value("relative_density"), 1e-9);
  EXPECT_LT(cell.results.energy_balance_error(), 0.003);
}

TEST(SquareCell, RecordsTheContactsOfADiscWithItsImages) {
  Experiment e(own_scene(square(0) + "[output]\ncontacts = true\n"));
  e.run(2);
  EXPECT_GT(e.value("network/coordination"), 0);
}

void expect_the_same_turned(const std::vector<std::string>& overrides, double error) {
  Experiment straight(own_scene(square(0), overrides)),
      turned(own_scene(square(std::numbers::pi / 6), overrides));
  straight.run(5);
  turned.run(5);
  const double c = std::cos(std::numbers::pi / 6), s = std::sin(std::numbers::pi / 6);
  for (const char* name : {"stress/", "cell/stress_"}) {
    const PlaneStress is = stress(turned, name), was = stress(straight, name);
    EXPECT_NEAR((c * c * is.xx + s * s * is.yy + 2 * c * s * is.xy) / was.xx, 1, error) << name;
    EXPECT_NEAR((s * s * is.xx + c * c * is.yy - 2 * c * s * is.xy) / was.yy, 1, error) << name;
    EXPECT_NEAR((c * s * (is.yy - is.xx) + (c * c - s * s) * is.xy) / was.yy, 0, error) << name;
  }
}

TEST(SquareCell, BearsTheSameInATurnedFrame) {
  expect_the_same_turned({"contact.hardness=1000"}, 1e-6);  // nothing indents
}

// The hardness is evaluated at steps that round-off may shift by one.
TEST(SquareCell, IndentsAsMuchInATurnedFrame) { expect_the_same_turned({}, 1e-5); }

// Four discs of two sizes, glued and with friction, where the cell lies and where it is cut open do not matter.
std::string four(double x, double y) {
  std::string text = std::string(steel) +
                     "friction = 0.3\ndamping = 0.1\n[[bond]]\nbetween = [\"316L\", \"316L\"]\n"
                     "origin = \"pressed\"\nstrength = \"100 MPa\"\nfracture_energy = \"5 "
                     "kJ/m^2\"\nthreshold = \"10 MPa\"\ngrowth = 0.5\n";
  for (const auto& at : {std::array{5.0, 5.0}, {15.2, 5.4}, {5.1, 15.3}, {15.3, 15.5}}) {
    const auto home = [](double v) { return v - 20.6 * std::floor(v / 20.6); };
    text += body(1e-3 * home(at[0] + x), 1e-3 * home(at[1] + y));
  }
  return text + R"([cell]
width = "20.6 mm"
height = "20.6 mm"
[output]
contacts = true
[[stage]]
name = "press"
kind = "compact"
duration = "0.3 ms"
[stage.cell]
strain_xx = -0.12
strain_yy = -0.08
[[stage]]
name = "shear"
kind = "shear"
duration = "0.3 ms"
[stage.cell]
strain_xy = 0.1
rotation = "-0.1 rad"
)";
}

TEST(Cell, MayBeCutOpenAnywhere) {
  Experiment here(own_scene(four(0, 0))), there(own_scene(four(13.7, -8.9)));
  here.run(10);
  there.run(10);
  ASSERT_GT(here.value("network/coordination"), 2);
  ASSERT_GT(here.value("bonds/area"), 0);
  for (const char* series :
       {"stress/xx", "cell/stress_xx", "stress/zz", "energy/external", "energy/friction",
        "network/coordination", "network/mean_force", "bonds/area", "contact_overlap"})
    EXPECT_NEAR(there.value(series) / here.value(series), 1, 1e-3) << series;
  EXPECT_NEAR((there.value("stress/yy") - here.value("stress/yy")) / here.value("stress/zz"), 0,
              1e-3);
  EXPECT_LT(here.results.energy_balance_error(), 0.01);
}

TEST(Cell, IsBitwiseTheSameForAnyThreads) {
  const auto hash = [](int threads) {
    Experiment e(own_scene(four(0, 0)), threads);
    e.run(3);
    return state_hash(e.simulation.world());
  };
  EXPECT_EQ(hash(2), hash(1));
}

// Two elastic discs in a cell that stands meet across its border and go on the other way.
TEST(Cell, LetsBodiesMeetAcrossItsBordersWithTheirMomentum) {
  Experiment e(own_scene(R"(
family = "compaction"
[[material]]
name = "steel"
density = "7990 kg/m^3"
youngs_modulus = "200 GPa"
poissons_ratio = 0.3
[[particle]]
name = "disc"
material = "steel"
outline = "disc"
diameter = "10 mm"
[particle.mesh]
boundary_edges = 40
rings = 1
[cell]
width = "30 mm"
height = "30 mm"
[[body]]
particle = "disc"
position = ["6 mm", "15 mm"]
velocity = ["-10 m/s", "0 m/s"]
[[body]]
particle = "disc"
position = ["25 mm", "15 mm"]
velocity = ["10 m/s", "0 m/s"]
[[stage]]
name = "fly"
kind = "settle"
duration = "0.2 ms"
)"));
  double contact = 0;
  e.run(100, [&] { contact = std::max(contact, e.results.energies().contact); });
  const auto& start = e.results.energies();
  EXPECT_GT(contact, 0.01 * start.kinetic);
  EXPECT_LT(e.results.energy_balance_error(), 1e-3);
  EXPECT_NEAR(e.value("energy/external"), 0, 1e-12 * start.kinetic);
  EXPECT_GT(start.kinetic, 0.9 * 2 * 0.5 * 7990 * 78.54e-6 * 1e-3 * 100);
}

TEST(Cell, HoldsStressesWhileItShears) {
  Experiment e("periodic/shear.toml");
  double time = 0, worst = 0, apart = 0;
  e.run(200, [&] {
    time = e.simulation.clock().time;
    if (time < 0.2e-3) return;
    const PlaneStress of_cell = stress(e, "cell/stress_"), mean = stress(e, "stress/");
    worst = std::max({worst, std::abs(of_cell.xx + 40e6), std::abs(of_cell.yy + 40e6)});
    apart += (std::abs(of_cell.xx - mean.xx) + std::abs(of_cell.yy - mean.yy)) / 2 / 160;
  });
  EXPECT_LT(worst, 0.03 * 40e6);
  EXPECT_LT(apart, 0.005 * 40e6);
  EXPECT_LT(e.results.energy_balance_error(), 2e-3);
  EXPECT_NEAR(e.value("cell/strain_xy"), 0.05 - 0.0019, 0.001);
  EXPECT_NEAR(e.value("cell/rotation"), -0.05, 1e-12);
}

// Simple shear by 2: rows slide past each other, and images change their numbers.
TEST(Cell, ShearsAnyDistance) {
  Experiment e(
      "periodic/shear.toml",
      {"stage.isostatic.duration=\"0.2 ms\"", "stage.shear.cell.strain_xy=1",
       "stage.shear.cell.rotation=\"-1 rad\"", "stage.shear.duration=\"4 ms\"",
       "stage.isostatic.cell.stress_xx=\"-5 MPa\"", "stage.isostatic.cell.stress_yy=\"-5 MPa\"",
       "stage.shear.cell.stress_xx=\"-5 MPa\"", "stage.shear.cell.stress_yy=\"-5 MPa\"",
       "stage.shear.cell.tolerance=1", "cell.width=\"5 mm\"", "packing[0].width=\"5 mm\"",
       "packing[0].class[0].number=24"});
  e.run(20);
  EXPECT_LT(e.results.energy_balance_error(), 0.01);
  EXPECT_NEAR(e.value("cell/rotation"), -1, 1e-9);
  EXPECT_GT(e.value("relative_density"), 0.7);
  EXPECT_LT(e.value("penetration"), 0.1);
}

}  // namespace
}  // namespace pulvis
