// Runs in three dimensions with bulk damping: what it takes is in the balance of energies, whatever its strength, and a ball that
// flies freely slows down as exp(-alpha t).
#include <gtest/gtest.h>

#include <cmath>

#include "components/body.hpp"
#include "tests/helpers/elastic_ball.hpp"
#include "tests/helpers/experiment.hpp"

namespace pulvis {
namespace {

Scene damped_ball(const std::vector<std::string>& changes) {
  return own_scene(elastic_ball("divisions = 2, rings = 1", "stiffness = 10", "0.2 mm"), changes);
}

// The strong ones are far beyond critical for every mode of the mesh: their steps are shorter.
TEST(DampedBall, BalancesItsEnergiesWhateverTheDamping) {
  for (const char* damping : {"mass_proportional=1e5 1/s", "stiffness_proportional=20 ns",
                              "mass_proportional=1e8 1/s", "stiffness_proportional=1 us"}) {
    Experiment e(damped_ball({std::string("material.steel.damping.") + damping}));
    e.run(50);
    EXPECT_GT(e.results.energies().bulk_damping, 0) << damping;
    EXPECT_LT(e.results.energy_balance_error(), 5e-3) << damping;
    EXPECT_GT(e.value("tool/top/force_z"), 0) << damping;
  }
}

TEST(DampedBall, FliesEverSlower) {
  constexpr double alpha = 2e4;
  Experiment e(damped_ball({"material.steel.damping.mass_proportional=2e4 1/s",
                            "body[0].velocity=[\"3 m/s\", \"-4 m/s\", \"0 m/s\"]",
                            "body[0].position=[\"0 mm\", \"0 mm\", \"5.5 mm\"]",
                            "tool.top.point=[\"0 mm\", \"0 mm\", \"12 mm\"]"}));
  const double before = e.results.momentum()[0];
  e.simulation.run_until(30e-6);
  const double passed = e.simulation.clock().time;
  EXPECT_NEAR(std::log(before / e.results.momentum()[0]) / (alpha * passed), 1, 2e-3);
}

TEST(DampedBall, TakesNothingUnlessAsked) {
  Experiment e(damped_ball({}));
  EXPECT_FALSE(e.simulation.world().has<DampingForce<ThreeD>>());
  EXPECT_FALSE(e.simulation.world().has<MassDamping>());
  EXPECT_FALSE(e.results.has("energy/bulk_damping"));
}

}  // namespace
}  // namespace pulvis
