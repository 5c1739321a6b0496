// Wedge calibration of a simulated microscope: friction and the detector's sensitivity that were put into it come
// back out of its volts, from one load and from several.
#include <cmath>

#include "tests/helpers/afm_run.hpp"

namespace pulvis {
namespace {

// Volts of one slope fit 1.3 as well as 1/1.3: the forces tell which of them it is.
TEST(AfmWedge, FrictionAndSensitivityComeBackOutOfTheVolts) {
  for (const double mu : {0.1, 1.3}) {
    // High friction sticks for longer, and takes a longer way to turn.
    const bool is_high = mu > 1;
    const int increments = is_high ? 16 : 12;
    const std::string distance = is_high ? "40 nm" : "4 nm";
    const Scene scene =
        afm_scene(std::string(coarse_beam) + inclined_plane(-12.5, mu) +
                      press_and_scan(increments, "60 nN") + press_and_scan(increments, "100 nN"),
                  {"detector.lateral_gain=2e5 V/rad", "action[1].distance=" + distance,
                   "action[3].distance=" + distance});
    AfmSimulation simulation(scene);
    // Lateral force by volts, as a small lateral force tells it.
    const Calibration c = simulation.calibrate();
    const double sensitivity = 1 / (2e5 * std::abs(c.lateral.spot.lateral));
    const AfmHistory history = history_of(simulation);
    const auto loops = friction_loops(scene, history);
    ASSERT_EQ(loops.size(), 2u);
    for (const FrictionLoop& loop : loops) {
      EXPECT_NEAR(loop.friction.value_or(0) / mu, 1, 0.01);
      EXPECT_NEAR(std::abs(loop.sensitivity.value_or(0)) / sensitivity, 1, 0.01);
      EXPECT_EQ(loop.other_root.has_value(), is_high);  // 10 would lock the tip
    }
    const auto all = calibrate_wedge(scene, loops);
    ASSERT_TRUE(all);
    EXPECT_EQ(all->facets.front().loads, 2);
    EXPECT_NEAR(all->friction.value / mu, 1, 0.01);
    EXPECT_NEAR(std::abs(all->sensitivity.value) / sensitivity, 1, 0.01);
  }
}

}  // namespace
}  // namespace pulvis
