// Frames of a scene with a periodic cell: where the cell is.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "components/cell.hpp"
#include "tests/helpers/experiment.hpp"

namespace pulvis {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;

// Discs that never touch: nothing but the cell moves them.
constexpr const char* apart = R"(
family = "compaction"
[[material]]
name = "Cu"
density = "8940 kg/m^3"
youngs_modulus = "115 GPa"
poissons_ratio = 0.35
yield_stress = "50 MPa"
[[particle]]
name = "disc"
material = "Cu"
outline = "disc"
diameter = "1 mm"
[particle.mesh]
boundary_edges = 24
rings = 1
[cell]
width = "8 mm"
height = "6 mm"
corner = ["3 mm", "1 mm"]
angle = "0.1 rad"
[[body]]
particle = "disc"
position = ["5 mm", "3 mm"]
[[body]]
particle = "disc"
position = ["9 mm", "4 mm"]
[[body]]
particle = "disc"
position = ["6 mm", "6 mm"]
[[stage]]
name = "shear"
kind = "shear"
duration = "0.1 ms"
[stage.cell]
strain_xx = -0.02
strain_yy = 0.01
strain_xy = 0.02
rotation = "-0.02 rad"
)";

// The first node of each disc, from the corner, in vectors of the cell.
std::vector<Point> in_cell(const Experiment& e) {
  const std::vector<double> cell = e.field("cell"), x = e.field("position");
  const auto inverse = Tensor<TwoD>{{cell[2], cell[4], cell[3], cell[5]}}.inverse();
  std::vector<Point> all;
  for (std::size_t disc = 0; disc < 3; ++disc) {
    const std::size_t first = disc * x.size() / 3;
    all.push_back(inverse * Point{x[first] - cell[0], x[first + 1] - cell[1]});
  }
  return all;
}

TEST(CellFrame, TellsCornerAndVectorsOfTheSceneAtTheStart) {
  Experiment e(own_scene(apart));
  const double c = std::cos(0.1), s = std::sin(0.1);
  const auto near = [](double value) { return DoubleNear(value, 1e-15); };
  EXPECT_THAT(e.field("cell"), ElementsAre(near(3e-3), near(1e-3), near(8e-3 * c), near(8e-3 * s),
                                           near(-6e-3 * s), near(6e-3 * c)));
}

// A disc stays where it is in the cell but for its own size, which is not strained.
TEST(CellFrame, MovesWithTheParticles) {
  Experiment e(own_scene(apart));
  const std::vector<Point> before = in_cell(e);
  const std::vector<double> cell = e.field("cell"), x = e.field("position");
  e.run(5);
  const std::vector<Point> after = in_cell(e);
  for (std::size_t disc = 0; disc < 3; ++disc)
    for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(after[disc][k], before[disc][k], 2e-3);
  const std::vector<double> now = e.field("cell");
  const auto area = [](const std::vector<double>& v) { return v[2] * v[5] - v[3] * v[4]; };
  EXPECT_NEAR(area(now) / area(cell), std::exp(-0.01), 1e-6);
  EXPECT_GT(std::hypot(now[0] - cell[0], now[1] - cell[1]), 5e-5);  // corner, and a disc:
  EXPECT_GT(std::abs(e.field("position")[0] - x[0]), 1e-5);
}

TEST(CellFrame, IsNoFieldOfAnyOtherScene) {
  const Experiment e("compaction/regular-25.toml");
  for (const FieldInfo& field : e.results.fields()) EXPECT_NE(field.name, "cell");
}

}  // namespace
}  // namespace pulvis
