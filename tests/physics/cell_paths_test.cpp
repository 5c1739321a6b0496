// Loading paths of a cell and of a die of four planes with the same keys: what is asked for is held, walls bear what the
// particles bear, a stage ends at its density, and a run goes on from a state that another has kept.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "components/cell.hpp"
#include "engine/run_failure.hpp"
#include "scenes/results/bond_results.hpp"
#include "tests/helpers/experiment.hpp"
#include "tests/helpers/initial_state.hpp"

namespace pulvis {
namespace {

constexpr const char* powder = R"(
family = "compaction"
seed = 2
[[material]]
name = "Cu"
density = "8940 kg/m^3"
youngs_modulus = "115 GPa"
poissons_ratio = 0.35
yield_stress = "50 MPa"
hardening_modulus = "440 MPa"
[[particle]]
name = "disc"
material = "Cu"
outline = "disc"
diameter = "1 mm"
[particle.mesh]
boundary_edges = 20
rings = 1
# Nothing indents: points of two surfaces that press each other are apart by the indentation, and with 20 edges the stress of
# the particles would be 0.9% above that of the borders.
[contact]
friction = 0.1
damping = 0.1
hardness = 1000
)";

constexpr const char* cell_of_16 = R"(
[cell]
width = "4 mm"
[[packing]]
kind = "random"
width = "4 mm"
density = 0.8
class = [{ particle = "disc", number = 16 }]
)";

// Without friction at the walls, which would bear a part of the stress.
constexpr const char* die_of_16 = R"(
[output]
contacts = true
[[friction]]
between = ["left", "Cu"]
coefficient = 0
[[friction]]
between = ["right", "Cu"]
coefficient = 0
[[friction]]
between = ["bottom", "Cu"]
coefficient = 0
[[friction]]
between = ["top", "Cu"]
coefficient = 0
[[packing]]
kind = "random"
width = "4 mm"
density = 0.74
class = [{ particle = "disc", number = 16 }]
[[tool]]
name = "left"
shape = "plane"
point = ["0 mm", "0 mm"]
normal = [1, 0]
[[tool]]
name = "right"
shape = "plane"
point = ["4 mm", "0 mm"]
normal = [-1, 0]
[[tool]]
name = "bottom"
shape = "plane"
point = ["0 mm", "0 mm"]
normal = [0, 1]
[[tool]]
name = "top"
shape = "plane"
point = ["0 mm", "packing top"]
normal = [0, -1]
)";

std::string stage(const std::string& name, const std::string& drive, const std::string& more = "") {
  return fmt::format(
      "[[stage]]\nname = \"{}\"\nkind = \"compact\"\nduration = \"0.4 ms\"\n{}[stage.cell]\n{}",
      name, more, drive);
}

class Paths : public testing::TestWithParam<const char*> {
 protected:
  static constexpr int samples = 90;  // 30 a stage
};

// Isostatic, then a ratio, then a constant mean stress; looked at when each stage is all but over.
TEST_P(Paths, HoldStressesRatiosAndMeans) {
  Experiment e(own_scene(std::string(powder) + GetParam() +
                         stage("isostatic", "stress_xx = \"-40 MPa\"\nstress_yy = \"-40 MPa\"\n") +
                         stage("ratio", "stress_ratio = 0.7\nstrain_yy = -0.03\n") +
                         stage("mean", "mean_stress = \"-60 MPa\"\nstrain_yy = -0.02\n")));
  int sample = 0;
  e.run(samples, [&] {
    const double xx = e.value("cell/stress_xx"), yy = e.value("cell/stress_yy");
    if (sample == 28) {  // at rest: the borders bear what the particles bear
      EXPECT_NEAR(xx / -40e6, 1, 0.01);
      EXPECT_NEAR(yy / -40e6, 1, 0.01);
      EXPECT_NEAR(e.value("stress/xx") / xx, 1, 0.005);
      EXPECT_NEAR(e.value("stress/yy") / yy, 1, 0.005);
    }
    if (sample == 55) {
      EXPECT_NEAR(xx / yy, 0.7, 0.02);
    }
    if (sample == 85) {
      EXPECT_NEAR((xx + yy) / -120e6, 1, 0.02);
    }
    ++sample;
  });
  EXPECT_LT(e.results.energy_balance_error(), 0.005);
}

INSTANTIATE_TEST_SUITE_P(CellAndWalls, Paths, testing::Values(cell_of_16, die_of_16),
                         [](const auto& tested) { return tested.index == 0 ? "Cell" : "Walls"; });

// The strains of the walls are those of the distances between them.
TEST(DrivenWalls, StrainByWhatTheirDistancesSay) {
  Experiment e(own_scene(std::string(powder) + die_of_16 +
                         stage("press", "strain_xx = -0.02\nstrain_yy = -0.1\n")));
  e.simulation.observe();
  e.results.sample();
  const double width = e.value("cell/width"), height = e.value("cell/height");
  Experiment again(own_scene(std::string(powder) + die_of_16 +
                             stage("press", "strain_xx = -0.02\nstrain_yy = -0.1\n")));
  again.run(4);
  EXPECT_NEAR(std::log(again.value("cell/width") / width), -0.02, 1e-6);
  EXPECT_NEAR(std::log(again.value("cell/height") / height), -0.1, 1e-6);
  EXPECT_NEAR(again.value("cell/strain_yy"), -0.1, 1e-9);
  // Both sides move alike, about the middle.
  EXPECT_NEAR(again.value("tool/left/position_x") + again.value("tool/right/position_x"), 4e-3,
              1e-12);
}

// What the stresses do along the strains is what is stored and dissipated, over the volume at the start.
TEST(CellEnergies, PerVolumeAreTheWorkOfTheStresses) {
  Experiment e(own_scene(std::string(powder) + cell_of_16 +
                         stage("press", "strain_xx = -0.03\nstrain_yy = -0.06\n")));
  double work = 0, volume_before = 0, volume_at_start = 0, xx = 0, yy = 0, exx = 0, eyy = 0;
  e.run(400, [&] {
    const double volume = e.value("cell/width") * e.value("cell/height");
    const double sx = e.value("cell/stress_xx"), sy = e.value("cell/stress_yy");
    if (volume_at_start == 0) volume_at_start = volume_before = volume;
    work += 0.25 * (volume + volume_before) *
            ((sx + xx) * (e.value("cell/strain_xx") - exx) +
             (sy + yy) * (e.value("cell/strain_yy") - eyy));
    volume_before = volume, xx = sx, yy = sy;
    exx = e.value("cell/strain_xx"), eyy = e.value("cell/strain_yy");
  });
  const double spent =
      volume_before * (e.value("cell/stored_energy") + e.value("cell/dissipated_energy"));
  EXPECT_NEAR(spent / work, 1, 2e-3);
}

TEST(CellStages, EndAtTheirDensity) {
  for (const char* powder_in : {cell_of_16, die_of_16}) {
    Experiment e(own_scene(
        std::string(powder) + powder_in +
        stage("press", "strain_yy = -0.3\nramp = 0.05\n", "until.relative_density = 0.86\n") +
        stage("hold", "strain_yy = 0\n")));
    e.simulation.run_until(1);
    e.simulation.observe();
    e.results.sample();
    EXPECT_NEAR(e.value("relative_density"), 0.86, 1e-4);  // at rest
    EXPECT_LT(e.simulation.clock().time, 0.7e-3);
  }
}

TEST(CellStages, ThatDoNotReachTheirDensityStopTheRun) {
  Experiment e(own_scene(std::string(powder) + cell_of_16 +
                         stage("press", "strain_yy = -0.02\n", "until.relative_density = 0.9\n") +
                         stage("hold", "strain_yy = 0\n")));
  EXPECT_THROW(e.simulation.run_until(1), RunFailure);
}

// Of one run through two stages, and of another that begins with the state between them.
TEST_F(InitialState, GoesOnAsTheRunThatKeptIt) {
  const std::string first =
      stage("press", "strain_xx = -0.03\nstrain_yy = -0.04\n", "keep_state = true\n");
  const std::string second = stage("shear", "strain_xx = 0.005\nstrain_yy = -0.02\n");
  const std::string before = std::string(powder) + cell_of_16;
  Experiment whole(own_scene(before + first + second));
  whole.run(20);

  kept(before, first);
  Experiment rest = gone_on(before, second);
  rest.run(10);
  for (const char* part_of : {"cell/stress_xx", "cell/stress_yy"})
    EXPECT_NEAR(rest.value(part_of) / whole.value(part_of), 1, 2e-3) << part_of;
  EXPECT_NEAR(rest.value("relative_density"), whole.value("relative_density"), 1e-9);
  EXPECT_NEAR(rest.value("cell/strain_yy"), whole.value("cell/strain_yy"), 1e-9);
  EXPECT_LT(rest.results.energy_balance_error(), 0.005);

  // Another powder's state is refused, and what is no state.
  const auto told = [&](const std::string& text) {
    try {
      load_scene_text(text, folder / "wrong.toml");
    } catch (const SceneError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  std::string changed = before;
  changed.replace(changed.find("friction = 0.1"), 14, "friction = 0.3");
  EXPECT_NE(told("initial_state = \"state.h5\"\n" + changed + second).find("another powder"),
            std::string::npos);
  std::ofstream(folder / "broken.h5") << "nothing";
  EXPECT_NE(told("initial_state = \"broken.h5\"\n" + before + second).find("keep_state"),
            std::string::npos);
  EXPECT_NE(told("initial_state = \"none.h5\"\n" + before + second).find("not a file"),
            std::string::npos);
}

// Crystals of grains that break in both stages.
TEST_F(InitialState, CountsTheTimesOfCracksFromItsOwnStart) {
  const std::string before = R"(
family = "compaction"
[[material]]
name = "salt"
density = "2165 kg/m^3"
youngs_modulus = "1.9 GPa"
poissons_ratio = 0.252
[[particle]]
name = "crystal"
material = "salt"
outline = "disc"
diameter = "0.25 mm"
grains = { number = 5, edges = 10 }
[[packing]]
kind = "random"
width = "0.8 mm"
density = 0.75
class = [{ particle = "crystal", number = 4 }]
[cell]
width = "0.8 mm"
[[bond]]
between = ["salt", "salt"]
origin = "initial"
inside = true
strength = "10 MPa"
fracture_energy = "10 J/m^2"
stiffness = 2
[contact]
friction = 0.2
damping = 0.1
)";
  const std::string press = R"(
[[stage]]
name = "press"
kind = "compact"
duration = "20 us"
cell = { strain_xx = -0.08, strain_yy = -0.08 }
)";
  const auto part = kept(before, press);
  const auto old = crack_rows(part->simulation.world(), 0);
  ASSERT_FALSE(old.empty());
  Experiment rest = gone_on(before, press);
  const auto inherited = crack_rows(rest.simulation.world(), 0);
  ASSERT_EQ(inherited.size(), old.size());
  for (std::size_t i = 0; i < old.size(); ++i) {
    EXPECT_EQ(inherited[i][0], old[i][0] - part->simulation.clock().time);
    EXPECT_LE(inherited[i][0], 0);
  }
  rest.run(10);
  const auto rows = crack_rows(rest.simulation.world(), 0);
  EXPECT_GT(rows.size(), old.size());
  EXPECT_GT(rows[old.size()][0], 0);
  EXPECT_TRUE(std::ranges::is_sorted(rows, {}, [](const auto& row) { return row[0]; }));
}

}  // namespace
}  // namespace pulvis
