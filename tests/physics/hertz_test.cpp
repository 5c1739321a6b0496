// Hertz: an elastic disc between rigid frictionless platens (facts: Johnson 1985, 4.45, 5.57).
#include <gtest/gtest.h>

#include <numbers>

#include "tests/helpers/contact_points.hpp"

namespace pulvis {
namespace {

double half_width(const Experiment& e, int tool) {
  Moments pressure;
  for_each_contact_point<ToolContact>(
      e, [&](const std::int32_t* key) { return key[2] == tool; },
      [&](const ContactPoint& point) { pressure.add(point.normal, point.x); });
  return pressure.half_width();
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
