// An elastic sphere between frictionless planes against Hertz's law, with what each contact moves the surface by at the other
// (Tatara 1991): the contact is two faces in radius.
#include <gtest/gtest.h>

#include "tests/helpers/elastic_ball.hpp"
#include "tests/helpers/experiment.hpp"

namespace pulvis {
namespace {

TEST(SphereBetweenPlates, BearsTheForceOfHertz) {
  Experiment e(
      own_scene(elastic_ball("divisions = 8, rings = 1", "stiffness = 10, damping = 0.3", "1 mm")));
  e.run(50);
  const double approach = (2 * ball_radius - e.value("tool/top/position_z")) / 2;
  const double force = (e.value("tool/top/force_z") - e.value("tool/bottom/force_z")) / 2;
  // What the mesh adds and what the springs give way by, 2% each, is of opposite sign.
  EXPECT_NEAR(force / force_on_ball(approach), 1, 0.02);
}

}  // namespace
}  // namespace pulvis
