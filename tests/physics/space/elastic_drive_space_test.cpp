// Tools behind a spring in three dimensions: they swing as a mass on a spring, in whatever direction they are moved, and at rest
// the spring bears what the powder does.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/helpers/elastic_ball.hpp"
#include "tests/helpers/experiment.hpp"
#include "tests/helpers/wrong.hpp"

namespace pulvis {
namespace {

Scene driven_ball(const std::vector<std::string>& changes, const std::string& more = "") {
  return own_scene(
      elastic_ball("divisions = 2, rings = 1", "stiffness = 10, damping = 0.3", "0.2 mm") + more,
      changes);
}

TEST(ElasticDriveInSpace, SwingsAsAMassOnASpring) {
  for (const double damping : {0.0, 0.1}) {
    Experiment e(
        driven_ball({"stage.press.duration=0.4 ms", "stage.press.move.top.stiffness=1e8 N/m",
                     "stage.press.move.top.mass=10 g", "stage.press.move.top.ramp=0.01",
                     "stage.press.move.top.damping=" + std::to_string(damping),
                     "stage.press.move.top.displacement=[\"0.1 mm\", \"-0.2 mm\", \"0.2 mm\"]"}));
    std::vector<double> crossings, peaks;
    double before = 0, when = 0, peak = 0;
    e.run(4000, [&] {
      const double time = e.simulation.clock().time, force = e.value("tool/top/drive_force");
      if (before > 0 && force <= 0 && time > 20e-6 && time < 0.39e-3) {
        crossings.push_back(when + (time - when) * before / (before - force));
        peaks.push_back(peak);
        peak = 0;
      }
      peak = std::max(peak, force);
      before = force;
      when = time;
    });
    ASSERT_GE(crossings.size(), 5u) << damping;
    const double free = 2 * std::numbers::pi * std::sqrt(0.01 / 1e8);
    EXPECT_NEAR((crossings[4] - crossings[0]) / 4, free / std::sqrt(1 - damping * damping),
                0.002 * free);
    EXPECT_NEAR(peaks[4] / peaks[3],
                std::exp(-2 * std::numbers::pi * damping / std::sqrt(1 - damping * damping)), 0.02);
    // It moves along the displacement alone, and swings about its far end.
    const double x = e.value("tool/top/position_x"), y = e.value("tool/top/position_y"),
                 z = e.value("tool/top/position_z") - 10e-3;
    EXPECT_NEAR(y, -2 * x, 1e-12);
    EXPECT_NEAR(z, 2 * x, 1e-12);
    EXPECT_GT(x, 0.05e-3);
  }
}

// The plate is behind its far end by the force over the spring's stiffness.
TEST(ElasticDriveInSpace, BearsAtRestWhatTheBallDoes) {
  constexpr double stiffness = 5e7;
  Experiment e(driven_ball({"stage.press.duration=0.4 ms", "stage.press.move.top.stiffness=5e7 N/m",
                            "stage.press.move.top.mass=2 g", "stage.press.move.top.damping=0.7"}));
  e.run(200);
  const double force = e.value("tool/top/force_z");
  ASSERT_GT(force, 500);
  EXPECT_NEAR(e.value("tool/top/drive_force"), force, 0.01 * force);
  EXPECT_NEAR(10e-3 - 0.2e-3 + force / stiffness, e.value("tool/top/position_z"),
              0.01 * force / stiffness);
  EXPECT_LT(e.results.energy_balance_error(), 5e-3);
}

// In a stage without it the spring bears nothing; until then, and at the end of a run, it does.
TEST(ElasticDriveInSpace, BearsNothingInAStageWithoutIt) {
  Experiment e(
      driven_ball({"stage.press.move.top.stiffness=5e7 N/m", "stage.press.move.top.mass=2 g"},
                  "[[stage]]\nname = \"hold\"\nkind = \"hold\"\nduration = \"5 us\"\n"));
  bool bore = false;
  e.run(100, [&] {
    const double time = e.simulation.clock().time;
    bore = bore || e.value("tool/top/drive_force") > 500;
    if (time > 51e-6) {
      EXPECT_EQ(e.value("tool/top/drive_force"), 0) << time;
    }
  });
  EXPECT_TRUE(bore);
  EXPECT_GT(e.value("tool/top/force_z"), 500);
}

TEST(ElasticDriveInSpace, IsRefusedBesideAServo) {
  const std::string message = message_of([] {
    driven_ball({"stage.press.move.top.stiffness=5e7 N/m", "stage.press.move.top.mass=20 g"},
                "servo = [{ tool = \"top\", force = \"1 N\", direction = [1, 0, 0] }]\n");
  });
  EXPECT_NE(message.find("stage[0].move[0].stiffness: 'top' has a servo in the same stage, "
                         "allowed: only one of the two"),
            std::string::npos)
      << message;
}

}  // namespace
}  // namespace pulvis
