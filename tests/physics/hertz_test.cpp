// Hertz: an elastic disc between rigid frictionless platens (facts: Johnson 1985, 4.45, 5.57).
#include <gtest/gtest.h>

#include <numbers>

#include "systems/contact/contact_kernel.hpp"
#include "tests/helpers/experiment.hpp"

namespace pulvis {
namespace {

// Half-width from the second moment of the contact pressure, 1/4 a^2 for Hertz' ellipse: unlike the
// outermost touching point it does not come in steps of the mesh.
double half_width(const Experiment& e, int tool) {
  const auto& pair = e.column<ContactPair<ToolContact>>();
  const auto& touches = e.column<ContactTouches<ToolContact>>();
  const auto& force = e.column<PointForce<ToolContact>>();
  const auto& curve = e.column<CurvePosition>();
  const Bodies& bodies = const_cast<Experiment&>(e).simulation.world().resource<Bodies>();
  double sum = 0, moment = 0;
  for (std::size_t r = 0; r < pair.table.rows; ++r) {
    const std::int32_t* key = pair.values() + 3 * r;
    if (key[2] != tool || touches.values()[r] == 0) continue;
    const auto& slot = bodies.slots[static_cast<std::size_t>(key[0])];
    const auto& edge = bodies.shape_of_slot(key[0]).edges[static_cast<std::size_t>(key[1])];
    const double* y = curve.values() + 2 * (slot.first_control + edge.first_control);
    for (std::size_t g = 0; g < 4; ++g) {
      const auto n = kernels::basis(kernels::edge_u[g]);
      const double x = n[0] * y[0] + n[1] * y[2] + n[2] * y[4] + n[3] * y[6];
      const double f = std::abs(force.values()[8 * r + 2 * g + 1]);
      sum += f;
      moment += f * x * x;
    }
  }
  return 2 * std::sqrt(moment / sum);
}

TEST(Hertz, LoadAndHalfWidthOfADiscBetweenPlatens) {
  Experiment e("basic/disc-platens.toml");
  e.run(10);
  const MaterialSpec& m = e.scene.materials[0];
  const double R = 5e-3, E = m.youngs_modulus / (1 - m.poissons_ratio * m.poissons_ratio);
  const double P =
      0.5 * (e.value("tool/top/force_y") - e.value("tool/bottom/force_y")) / e.scene.thickness;
  const double a = std::sqrt(4 * P * R / (std::numbers::pi * E));
  const double approach = 2 * P / (std::numbers::pi * E) * (2 * std::log(4 * R / a) - 1);
  const double moved = e.value("tool/bottom/position_y") - e.value("tool/top/position_y") + 2 * R;
  EXPECT_NEAR(half_width(e, 0) / a, 1, 0.02);
  EXPECT_NEAR(half_width(e, 1) / a, 1, 0.02);
  // The load that belongs to this approach: d ln P / d ln approach is about 1.1.
  EXPECT_NEAR(moved / approach, 1, 0.018);
}

}  // namespace
}  // namespace pulvis
