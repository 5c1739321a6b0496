// The periodic cell in three dimensions against laws: it has no walls and no place, what it bears is what its particles bear,
// stresses turn with it, and are held.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "scenes/results/state_hash.hpp"
#include "tests/helpers/elastic_ball.hpp"
#include "tests/helpers/experiment.hpp"

namespace pulvis {
namespace {

// Without inerters: the steps of the highest mode differ in the last digits with where particles are, and with them the ringing.
constexpr const char* copper = R"(
family = "compaction"
dimension = 3
[[material]]
name = "copper"
density = "8940 kg/m^3"
youngs_modulus = "115 GPa"
poissons_ratio = 0.35
yield_stress = "50 MPa"
hardening_modulus = "440 MPa"
[[particle]]
name = "ball"
material = "copper"
shape = "sphere"
diameter = "1 mm"
[particle.mesh]
divisions = 4
rings = 1
[output]
particle_stress = true
contacts = true
[contact]
stiffness = 4
inertance = 0
)";

std::string ball(double x, double y, double z) {
  return fmt::format(
      "[[body]]\nparticle = \"ball\"\nposition = [\"{:.17g} mm\", \"{:.17g} mm\", \"{:.17g} "
      "mm\"]\n",
      x, y, z);
}

std::string cubic_cell(double edge) {
  return fmt::format("[cell]\nwidth = \"{0} mm\"\ndepth = \"{0} mm\"\nheight = \"{0} mm\"\n", edge);
}

std::string cell_stage(const std::string& name, const std::string& duration,
                       const std::string& drive) {
  return fmt::format(
      "[[stage]]\nname = \"{}\"\nkind = \"compact\"\nduration = \"{}\"\n[stage.cell]\n{}\n", name,
      duration, drive);
}

constexpr double strain = -0.06;
std::string isotropic() {
  return fmt::format("strain_xx = {0}\nstrain_yy = {0}\nstrain_zz = {0}\n", strain);
}

// Around a cube of 1 mm.
std::string six_planes() {
  std::string planes;
  for (int axis = 0; axis < 3; ++axis)
    for (const int side : {0, 1}) {
      std::array<double, 3> point{}, normal{};
      point.at(static_cast<std::size_t>(axis)) = side;
      normal.at(static_cast<std::size_t>(axis)) = 1 - 2 * side;
      planes += fmt::format(
          "[[tool]]\nname = \"plane{0}\"\nshape = \"plane\"\npoint = [\"{1} mm\", \"{2} mm\", "
          "\"{3} mm\"]\nnormal = [{4}, {5}, {6}]\n",
          2 * axis + side, point[0], point[1], point[2], normal[0], normal[1], normal[2]);
    }
  return planes;
}

TEST(CubicCell, BearsWhatASphereBetweenSixPlanesBears) {
  Experiment cell(own_scene(copper + ball(0.5, 0.5, 0.5) + cubic_cell(1) +
                            cell_stage("press", "0.06 ms", isotropic())));
  cell.run(10);
  std::string moves;
  const double way = (1 - std::exp(strain)) / 2;
  for (int axis = 0; axis < 3; ++axis)
    for (const int side : {0, 1}) {
      std::array<double, 3> move{};
      move.at(static_cast<std::size_t>(axis)) = way * (1 - 2 * side);
      moves += fmt::format(
          "[[stage.move]]\ntool = \"plane{}\"\ndisplacement = [\"{:.17g} mm\", \"{:.17g} mm\", "
          "\"{:.17g} mm\"]\n",
          2 * axis + side, move[0], move[1], move[2]);
    }
  Experiment box(own_scene(
      copper + ball(0.5, 0.5, 0.5) + six_planes() +
      "[[stage]]\nname = \"press\"\nkind = \"compact\"\nduration = \"0.06 ms\"\n" + moves));
  box.run(10);
  ASSERT_LT(box.value("stress/zz"), -15e6);
  for (const char* part : {"xx", "yy", "zz"}) {
    const std::string name = fmt::format("stress/{}", part);
    EXPECT_NEAR(cell.value(name) / box.value(name), 1, 0.01) << part;
    EXPECT_NEAR(cell.value(fmt::format("cell/stress_{}", part)) / cell.value(name), 1, 0.01)
        << part;
  }
  EXPECT_NEAR(cell.value("energy/external") / box.value("energy/external"), 1, 0.01);
  EXPECT_NEAR(cell.value("relative_density") / box.value("relative_density"), 1, 1e-9);
  EXPECT_LT(cell.results.energy_balance_error(), 0.003);
}

// An elastic ball that touches its own images above and below; beside it there is room.
TEST(CubicCell, BearsTheForceOfHertz) {
  Experiment e(own_scene(R"(
family = "compaction"
dimension = 3
material = [{ name = "steel", density = "7990 kg/m^3", youngs_modulus = "200 GPa", poissons_ratio = 0.3 }]
particle = [{ name = "ball", material = "steel", shape = "sphere", diameter = "10 mm", mesh = { divisions = 8, rings = 1 } }]
body = [{ particle = "ball", position = ["6 mm", "6 mm", "5 mm"] }]
cell = { width = "12 mm", depth = "12 mm", height = "10 mm" }
contact = { stiffness = 10, damping = 0.3 }
)" + cell_stage("press", "0.05 ms", "strain_zz = -0.105\n")));
  e.run(50);
  const double force = -e.value("cell/stress_zz") * e.value("cell/width") * e.value("cell/depth");
  const double approach = (2 * ball_radius - e.value("cell/height")) / 2;
  // As between plates (hertz_space_test.cpp).
  EXPECT_NEAR(force / force_on_ball(approach), 1, 0.02);
}

// The planes of a box, driven like a cell: the same lattice, as its mirror images are its periods.
TEST(DrivenBox, BearsWhatACellBears) {
  const std::string drive = cell_stage("press", "0.06 ms", isotropic()) +
                            cell_stage("hold", "0.2 ms",
                                       "stress_xx = \"-10 MPa\"\nstress_yy = \"-10 MPa\"\n"
                                       "stress_zz = \"-25 MPa\"\n");
  Experiment cell(own_scene(copper + ball(0.5, 0.5, 0.5) + cubic_cell(1) + drive));
  Experiment box(own_scene(copper + ball(0.5, 0.5, 0.5) + six_planes() + drive));
  EXPECT_TRUE(box.simulation.world().resource<ContactRules>().servos);
  cell.run(10);
  box.run(10);
  for (const char* part : {"xx", "yy", "zz"}) {
    const std::string stress = fmt::format("cell/stress_{}", part),
                      strain = fmt::format("cell/strain_{}", part);
    EXPECT_NEAR(box.value(stress) / (part[0] == 'z' ? -25e6 : -10e6), 1, 0.03) << part;
    EXPECT_NEAR(cell.value(stress) / box.value(stress), 1, 0.05) << part;
    EXPECT_NEAR(cell.value(strain) / box.value(strain), 1, 0.02) << part;
  }
  EXPECT_LT(box.results.energy_balance_error(), 0.003);
}

// The same lattice pressed along each axis.
TEST(CubicCell, HasNoPreferredAxis) {
  const auto along = [](const char* part) {
    Experiment e(
        own_scene(copper + ball(0.5, 0.5, 0.5) + cubic_cell(1) +
                  cell_stage("press", "0.03 ms", fmt::format("strain_{} = -0.05\n", part))));
    e.run(5);
    return std::array{e.value(fmt::format("cell/stress_{}", part)), e.value("energy/external")};
  };
  const auto x = along("xx"), y = along("yy"), z = along("zz");
  ASSERT_LT(z[0], -5e6);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(x[i] / z[i], 1, 1e-6);
    EXPECT_NEAR(y[i] / z[i], 1, 1e-6);
  }
}

// Pressed along z, then turned by a quarter about x: the stress turns with the powder, and nothing does work.
TEST(CubicCell, TurnsWithItsStress) {
  Experiment e(
      own_scene(copper + ball(0.5, 0.5, 0.5) + cubic_cell(1) +
                cell_stage("press", "0.03 ms", "strain_zz = -0.05\n") +
                cell_stage("turn", "0.3 ms", "rotation = [\"90 deg\", \"0 deg\", \"0 deg\"]\n")));
  double along = 0, plastic = 0;
  e.run(11, [&] {
    if (e.simulation.clock().time > 0.0301e-3) return;
    along = e.value("cell/stress_zz");
    plastic = e.value("energy/plastic");
  });
  ASSERT_LT(along, -5e6);
  EXPECT_NEAR(e.value("cell/stress_yy") / along, 1, 0.02);
  EXPECT_NEAR(e.value("cell/stress_zz") / along, 0, 0.02);
  EXPECT_NEAR(e.value("energy/plastic") / plastic, 1, 1e-3);
  EXPECT_NEAR(e.value("cell/rotation_x"), std::numbers::pi / 2, 1e-12);
  EXPECT_LT(e.results.energy_balance_error(), 0.003);
}

// Four spheres with friction and welds: where the cell lies and where it is cut open do not matter.
std::string four(double x, double y, double z) {
  std::string text =
      std::string(copper) +
      "friction = 0.3\ndamping = 0.1\n[[bond]]\n"
      "between = [\"copper\", \"copper\"]\norigin = \"pressed\"\nstrength = \"100 "
      "MPa\"\nfracture_energy = \"5 kJ/m^2\"\nthreshold = \"10 MPa\"\ngrowth = 0.5\n";
  const double edge = 1.45;
  for (const auto& at :
       {std::array{0.1, 0.12, 0.11}, {0.83, 0.84, 0.1}, {0.82, 0.1, 0.83}, {0.1, 0.83, 0.84}}) {
    const auto home = [&](double v) { return v - edge * std::floor(v / edge); };
    text += ball(home(at[0] + x), home(at[1] + y), home(at[2] + z));
  }
  return text + cubic_cell(edge) +
         cell_stage("press", "0.03 ms",
                    "strain_xx = -0.05\nstrain_yy = -0.04\nstrain_zz = -0.06\n") +
         cell_stage("shear", "0.03 ms",
                    "strain_zx = 0.05\nrotation = [\"0 rad\", \"0.05 rad\", \"0 rad\"]\n");
}

TEST(SpaceCell, MayBeCutOpenAnywhere) {
  Experiment here(own_scene(four(0, 0, 0))), there(own_scene(four(0.97, -0.63, 0.41)));
  here.run(10);
  there.run(10);
  ASSERT_GT(here.value("network/coordination"), 6);
  ASSERT_GT(here.value("bonds/area"), 0);
  for (const char* series :
       {"stress/xx", "stress/yy", "stress/zz", "stress/zx", "cell/stress_xx", "cell/stress_zx",
        "energy/external", "energy/friction", "network/coordination", "network/mean_force",
        "bonds/area", "contact_overlap"})
    EXPECT_NEAR(there.value(series) / here.value(series), 1, 1e-3) << series;
  EXPECT_LT(here.results.energy_balance_error(), 0.01);
}

// Hill & Mandel: once the powder is at rest, the mean stress of the particles is that across the borders.
TEST(SpaceCell, BearsWhatItsParticlesBear) {
  Experiment e(own_scene(four(0, 0, 0)));
  e.run(10);
  const double largest = std::abs(e.value("stress/zz"));
  for (const char* part : {"xx", "yy", "zz", "xy", "yz", "zx"})
    EXPECT_NEAR(e.value(fmt::format("cell/stress_{}", part)) / largest,
                e.value(fmt::format("stress/{}", part)) / largest, 0.01)
        << part;
}

TEST(SpaceCell, IsBitwiseTheSameForAnyThreads) {
  const auto hash = [](int threads) {
    Experiment e(own_scene(four(0, 0, 0)), threads);
    e.run(3);
    return state_hash(e.simulation.world());
  };
  EXPECT_EQ(hash(2), hash(1));
}

// Two elastic spheres in a cell that stands meet across its border and go on the other way.
TEST(SpaceCell, LetsBodiesMeetAcrossItsBordersWithTheirMomentum) {
  Experiment e(own_scene(R"(
family = "compaction"
dimension = 3
[[material]]
name = "steel"
density = "7990 kg/m^3"
youngs_modulus = "200 GPa"
poissons_ratio = 0.3
[[particle]]
name = "ball"
material = "steel"
shape = "sphere"
diameter = "1 mm"
[particle.mesh]
divisions = 4
rings = 1
[cell]
width = "3 mm"
depth = "2 mm"
height = "2 mm"
[[body]]
particle = "ball"
position = ["0.6 mm", "1 mm", "1 mm"]
velocity = ["-10 m/s", "0 m/s", "0 m/s"]
[[body]]
particle = "ball"
position = ["2.5 mm", "1 mm", "1 mm"]
velocity = ["10 m/s", "0 m/s", "0 m/s"]
[[stage]]
name = "fly"
kind = "settle"
duration = "0.02 ms"
)"));
  double contact = 0;
  e.run(100, [&] { contact = std::max(contact, e.results.energies().contact); });
  EXPECT_GT(contact, 0.001 * e.results.energies().kinetic);
  EXPECT_LT(e.results.energy_balance_error(), 1e-3);
  EXPECT_NEAR(e.value("energy/external"), 0, 1e-12 * e.results.energies().kinetic);
}

TEST(SpaceCell, HoldsStressesWhileItShears) {
  Experiment e("periodic/spheres-shear.toml",
               {"cell.width=\"2.2 mm\"", "cell.depth=\"2.2 mm\"", "packing[0].width=\"2.2 mm\"",
                "packing[0].depth=\"2.2 mm\"", "packing[0].class[0].number=12"});
  double worst = 0;
  const double begin = e.scene.stages[0].duration;
  e.run(100, [&] {
    if (e.simulation.clock().time < begin) return;
    for (const char* part : {"xx", "yy", "zz"})
      worst = std::max(worst, std::abs(e.value(fmt::format("cell/stress_{}", part)) / -20e6 - 1));
  });
  EXPECT_LT(worst, 0.05);
  EXPECT_LT(e.results.energy_balance_error(), 5e-3);
  EXPECT_GT(std::abs(e.value("cell/stress_zx")), 2e6);
}

// The lateral stresses follow the axial one.
TEST(SpaceCell, KeepsRatiosAndMeansOfItsStresses) {
  const std::string powder = four(0, 0, 0);
  const std::string start = powder.substr(0, powder.find("[[stage]]"));
  Experiment ratio(
      own_scene(start + cell_stage("press", "0.03 ms", isotropic()) +
                cell_stage("lean", "0.05 ms", "strain_zz = -0.03\nstress_ratio = 0.8\n")));
  ratio.run(10);
  ASSERT_LT(ratio.value("cell/stress_zz"), -10e6);
  for (const char* part : {"xx", "yy"})
    EXPECT_NEAR(ratio.value(fmt::format("cell/stress_{}", part)) / ratio.value("cell/stress_zz"),
                0.8, 0.03);
  const double mean = -30e6;
  Experiment held(
      own_scene(start + cell_stage("press", "0.03 ms", isotropic()) +
                cell_stage("lean", "0.05 ms", "strain_zz = -0.03\nmean_stress = \"-30 MPa\"\n")));
  held.run(10);
  EXPECT_NEAR(
      (held.value("cell/stress_xx") + held.value("cell/stress_yy") + held.value("cell/stress_zz")) /
          3 / mean,
      1, 0.03);
  EXPECT_NEAR((held.value("cell/stress_xx") - held.value("cell/stress_yy")) / mean, 0, 0.05);
}

}  // namespace
}  // namespace pulvis
