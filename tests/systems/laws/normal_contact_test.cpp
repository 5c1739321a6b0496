// Contact pressure where surfaces indent: the hardness limits it, work is done, and indentations stay or fade.
#include "systems/laws/normal_contact.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace pulvis::kernels {
namespace {

constexpr double edge = 1e-3, kappa = 1e14, hardness = 600e6;  // m, Pa/m, Pa

double pressure_at(double depth) {
  return normal_traction<Lane>(Lane(depth), Lane{}, Lane(kappa), Lane{}, Lane(1 / edge))
      .pressure[0];
}
struct Step {
  double depth, work;  // m, J/m^2
};
Step indent(double gap, double before, double limit = hardness, double left = 1) {
  const auto of = indentation<Lane>(Lane(gap), Lane(before), {Lane(limit), Lane(left)}, 1,
                                    Lane(kappa), Lane(1 / edge));
  return {of.depth[0], of.work[0]};
}

constexpr double half_depth = half_indentation * edge;
double limit_at(double depth) { return hardness * depth / (depth + half_depth); }

// What the linear part of the spring bears follows H d/(d + d_0): a tenth of H at d_0/9, nine tenths at 9 d_0.
TEST(Indentation, LimitsThePressureToTheHardness) {
  double before = 0;
  for (const double gap : {0.1e-6, 1e-6, 5e-6, 7e-6, 20e-6, 40e-6}) {
    const Step now = indent(gap, 0);
    EXPECT_GT(now.depth, before) << gap;
    EXPECT_NEAR(kappa * (gap - now.depth) / limit_at(now.depth), 1, 1e-9) << gap;
    EXPECT_NEAR(now.work / (0.5 * pressure_at(gap - now.depth) * now.depth), 1, 1e-9) << gap;
    before = now.depth;
  }
  EXPECT_NEAR(kappa * (indent(40e-6, 0).depth - 40e-6) / -hardness, 1, 0.08);
  // The same depth bears less until the limit is reached again.
  EXPECT_EQ(indent(15e-6, 12e-6).depth, 12e-6);
  EXPECT_EQ(indent(15e-6, 12e-6).work, 0);
}

// Pressed slowly to three times the gap of first indentation, then released: what the springs store and give back, and the
// plastic work, are the work of the pressure.
TEST(Indentation, SpendsTheWorkOfThePressure) {
  constexpr int steps = 20000;
  constexpr double deepest = 18e-6;
  double depth = 0, spent = 0, work = 0, before = 0, gap_before = 0;
  for (int i = 1; i <= 2 * steps; ++i) {
    const double gap = deepest * (i <= steps ? i : 2 * steps - i) / steps;
    const Step now = indent(gap, depth);
    EXPECT_GE(now.depth, depth);
    depth = now.depth;
    spent += now.work;
    const double pressure = pressure_at(gap - depth);
    work += 0.5 * (pressure + before) * (gap - gap_before);
    before = pressure;
    gap_before = gap;
  }
  EXPECT_EQ(before, 0);
  EXPECT_NEAR(work / spent, 1, 1e-4);
  EXPECT_NEAR(kappa * (deepest - depth) / limit_at(depth), 1, 1e-6);
}

// As the element behind flows an indentation fades: the spring is pressed as much deeper, and the work comes back.
TEST(Indentation, FadesWithTheShareThatIsLeft) {
  const Step now = indent(6e-6, 4e-6, hardness, 0.9);
  EXPECT_NEAR(now.depth, 3.6e-6, 1e-18);
  EXPECT_NEAR(now.work, pressure_at(6e-6 - 3.6e-6) * -0.4e-6, 1e-9);
}

// Not where the limit is infinite, or so high that the springs stiffen before; never deeper than a share of the edge; and not
// by a gap that is no number: it stays visible in the depth.
TEST(Indentation, HasItsLimits) {
  constexpr double none = std::numeric_limits<double>::infinity();
  EXPECT_EQ(indent(100e-6, 0, none).depth, 0);
  EXPECT_EQ(indent(100e-6, 0, none).work, 0);
  EXPECT_EQ(indent(100e-6, 0, 1.01 * hardest * kappa * stiffening_depth * edge).depth, 0);
  EXPECT_DOUBLE_EQ(indent(0.9 * edge, 0).depth, deepest_indentation * edge);
  EXPECT_EQ(indent(-1e-6, 3e-6).depth, 3e-6);
  EXPECT_EQ(indent(std::nan(""), 3e-6).depth, 3e-6);
}

}  // namespace
}  // namespace pulvis::kernels
