// An elastic sphere between frictionless planes against Hertz's law, with what each contact moves the surface by at the other
// (Tatara 1991): the contact is two faces in radius.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/helpers/experiment.hpp"

namespace pulvis {
namespace {

constexpr double ball_radius = 5e-3, ball_modulus = 200e9, ball_poisson = 0.3;

const char* const pressed_ball = R"(
family = "compaction"
dimension = 3
material = [{ name = "steel", density = "7990 kg/m^3", youngs_modulus = "200 GPa", poissons_ratio = 0.3 }]
particle = [{ name = "ball", material = "steel", shape = "sphere", diameter = "10 mm", mesh = { divisions = 8, rings = 1 } }]
body = [{ particle = "ball", position = ["0 mm", "0 mm", "5 mm"] }]
tool = [
  { name = "bottom", shape = "plane", point = ["0 mm", "0 mm", "0 mm"], normal = [0, 0, 1] },
  { name = "top", shape = "plane", point = ["0 mm", "0 mm", "10 mm"], normal = [0, 0, -1] },
]
contact = { stiffness = 10, damping = 0.3 }

[[stage]]
name = "press"
kind = "compact"
duration = "50 us"
move = [{ tool = "top", displacement = ["0 mm", "0 mm", "-1 mm"], ramp = 0.5 }]
)";

double force_of_law(double approach) {
  constexpr double star = ball_modulus / (1 - ball_poisson * ball_poisson);
  double force = 0;
  for (int i = 0; i < 100; ++i) {
    const double a2 = std::pow(3 * force * ball_radius / (4 * star), 2.0 / 3),
                 far2 = a2 + 4 * ball_radius * ball_radius;
    const double far = 2 * (1 + ball_poisson) * ball_radius * ball_radius / std::pow(far2, 1.5) +
                       (1 - ball_poisson * ball_poisson) / std::sqrt(far2);
    const double near = approach + force / (std::numbers::pi * ball_modulus) * far;
    force = 4.0 / 3 * star * std::sqrt(ball_radius) * std::pow(near, 1.5);
  }
  return force;
}

TEST(SphereBetweenPlates, BearsTheForceOfHertz) {
  Experiment e(own_scene(pressed_ball));
  e.run(50);
  const double approach = (2 * ball_radius - e.value("tool/top/position_z")) / 2;
  const double force = (e.value("tool/top/force_z") - e.value("tool/bottom/force_z")) / 2;
  // What the mesh adds and what the springs give way by, 2% each, is of opposite sign.
  EXPECT_NEAR(force / force_of_law(approach), 1, 0.02);
}

}  // namespace
}  // namespace pulvis
