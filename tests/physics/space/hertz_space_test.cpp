// An elastic sphere between frictionless planes against Hertz's law, with what each contact moves the surface by at the other
// (Tatara 1991): the contact is two faces in radius.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/helpers/elastic_ball.hpp"
#include "tests/helpers/experiment.hpp"

namespace pulvis {
namespace {

constexpr double ball_radius = 5e-3, ball_modulus = 200e9, ball_poisson = 0.3;

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
  Experiment e(
      own_scene(elastic_ball("divisions = 8, rings = 1", "stiffness = 10, damping = 0.3", "1 mm")));
  e.run(50);
  const double approach = (2 * ball_radius - e.value("tool/top/position_z")) / 2;
  const double force = (e.value("tool/top/force_z") - e.value("tool/bottom/force_z")) / 2;
  // What the mesh adds and what the springs give way by, 2% each, is of opposite sign.
  EXPECT_NEAR(force / force_of_law(approach), 1, 0.02);
}

}  // namespace
}  // namespace pulvis
