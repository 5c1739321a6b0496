// Thick-walled cylinder under inner pressure, scenes/benchmark/thick-cylinder.toml: Lame's solution while
// it is elastic, its limit pressure when all of it flows, and the order at which a finer mesh gets there.
#include <gtest/gtest.h>

#include <array>
#include <numbers>

#include "components/body.hpp"
#include "components/surface.hpp"
#include "tests/helpers/experiment.hpp"

namespace pulvis {
namespace {

constexpr const char* scene_file = "benchmark/thick-cylinder.toml";
constexpr double a = 5e-3, b = 10e-3;  // m
constexpr double youngs = 200e9, poisson = 0.3, yield = 24e6;

std::vector<std::string> mesh(int edges, int rings) {
  return {"particle.cylinder.mesh.boundary_edges=" + std::to_string(edges),
          "particle.cylinder.mesh.rings=" + std::to_string(rings)};
}

// Radial force on the bore over Lame's in plane strain, less 1, after a displacement that nothing yields
// at.
double error_of_lame(std::vector<std::string> overrides) {
  for (const char* slow : {"stage.widen.move.bore.displacement=[\"0.0003 mm\", \"0 mm\"]",
                           "stage.widen.move.bore.ramp=0.5", "stage.widen.duration=\"0.2 ms\""})
    overrides.emplace_back(slow);
  Experiment e(scene_file, overrides);
  e.run(10);
  EXPECT_EQ(e.results.energies().plastic, 0);
  EXPECT_LT(e.results.energy_balance_error(), 0.01);
  const double u = e.value("tool/bore/position_x");
  const double pressure =
      youngs * u * (b * b - a * a) / ((1 + poisson) * a * ((1 - 2 * poisson) * a * a + b * b));
  return -e.value("tool/bore/force_x") / (pressure * 2 * std::numbers::pi * a * e.scene.thickness) -
         1;
}

// Mean pressure over the limit pressure at the present radii, while the bore moves at its full speed.
double limit_of(std::vector<std::string> overrides) {
  Experiment e(scene_file, overrides);
  double sum = 0;
  int samples = 0;
  e.run(200, [&] {
    const double share = e.simulation.clock().time / e.simulation.clock().end;
    if (share < 0.55 || share > 0.9) return;
    const double bore = a + e.value("tool/bore/position_x");
    const double outer = std::sqrt(b * b - a * a + bore * bore);  // the wall keeps its area
    const double limit = 2 / std::sqrt(3.0) * yield * std::log(outer / bore);
    sum +=
        -e.value("tool/bore/force_x") / (2 * std::numbers::pi * bore * e.scene.thickness * limit);
    ++samples;
  });
  EXPECT_GT(samples, 50);
  return sum / samples;
}

// Only the nodes of the bore are held, and go outwards by as much as the constraint.
TEST(ThickCylinder, ConstraintHoldsTheBoreAlone) {
  Experiment e(scene_file);
  EXPECT_EQ(e.column<ConstraintTarget>().table.rows, 48U);
  const auto& x = e.column<Position<TwoD>>();
  const auto radius = [&](std::size_t n) {
    return std::hypot(x.lanes()[2 * n][0], x.lanes()[2 * n + 1][0]);
  };
  std::vector<double> before;
  for (std::size_t n = 0; n < 5 * 48; ++n) before.push_back(radius(n));
  e.run(10);
  const double travel = e.value("tool/bore/position_x");
  EXPECT_NEAR(travel, 0.005e-3, 1e-12);
  for (std::size_t n = 0; n < 5 * 48; ++n) {
    if (before[n] < 5.2e-3)
      EXPECT_NEAR(radius(n) - before[n], travel, 1e-14);
    else
      EXPECT_LT(radius(n) - before[n], 0.9 * travel);
  }
}

TEST(ThickCylinder, WidensAsLameSays) { EXPECT_NEAR(error_of_lame({}), 0, 0.01); }

TEST(ThickCylinder, StiffnessConvergesAtSecondOrder) {
  std::array<double, 3> error{};
  for (std::size_t i = 0; i < 3; ++i) error[i] = error_of_lame(mesh(24 << i, 2 << i));
  EXPECT_NEAR(std::log2(error[0] / error[1]), 2, 0.25);
  EXPECT_NEAR(std::log2(error[1] / error[2]), 2, 0.15);
}

TEST(ThickCylinder, FlowsAtItsLimitPressure) {
  EXPECT_NEAR(limit_of({}), 1, 0.01);
  EXPECT_NEAR(limit_of(mesh(96, 8)), 1, 0.005);
  EXPECT_NEAR(limit_of({"element.formulation=four-point"}), 1, 0.01);
}

// The standard element is too stiff for flow that keeps its volume, in a coarse mesh by much.
TEST(ThickCylinder, StandardElementGoesPastTheLimit) {
  std::vector<std::string> coarse = mesh(24, 2);
  const double mean_dilatation = limit_of(coarse);
  coarse.emplace_back("element.formulation=standard");
  EXPECT_GT(limit_of(coarse), 1.1);
  EXPECT_NEAR(mean_dilatation, 1, 0.03);
}

}  // namespace
}  // namespace pulvis
