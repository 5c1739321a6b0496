// A tip against surfaces: Coulomb's law, wedges, the order of twist, bending and slip, pull-off.
#include <cmath>
#include <numbers>

#include "scenes/afm_figures.hpp"
#include "scenes/afm_loop.hpp"
#include "tests/afm/lever.hpp"

namespace pulvis {
namespace {

AfmHistory history_of(const Scene& scene, int threads = 1) {
  AfmSimulation simulation(scene, threads);
  AfmHistory history;
  simulation.run([&](double time, const std::vector<double>& row) {
    history.times.push_back(time);
    history.rows.push_back(row);
    return true;
  });
  return history;
}

std::string beam_on(const std::string& surface_and_actions) {
  return beam_with_tip + surface_and_actions;
}

constexpr const char* press_and_loop = R"(
[[action]]
kind = "press"
force = "100 nN"
increments = 3

[[action]]
kind = "scan"
distance = "4 nm"
set_point = "force"
increments = 20
)";

struct Slope {
  double degrees, uphill, downhill;  // of L, mu = 0.1
};

class Wedge : public testing::TestWithParam<Slope> {};

TEST_P(Wedge, AStiffTipDrawsWithTheForcesOfTheFormula) {
  const Slope& slope = GetParam();
  const Scene scene =
      afm_scene(beam_on("[surface]\nshape = \"plane\"\nfriction = 0.1\nincline = \"" +
                        std::to_string(slope.degrees) + " deg\"\n" + press_and_loop));
  const AfmHistory history = history_of(scene);
  const FrictionLoop loop = friction_loops(scene, history).front();
  EXPECT_NEAR(loop.load, 100e-9, 1e-14);
  EXPECT_NEAR(loop.forth / loop.load, slope.uphill, 0.005 * std::abs(slope.uphill));
  EXPECT_NEAR(loop.back / loop.load, slope.downhill, 0.005 * std::abs(slope.downhill));
  if (slope.degrees == 0) return;
  ASSERT_TRUE(loop.friction);  // from volts alone
  EXPECT_NEAR(*loop.friction, 0.1, 0.002);
}

INSTANTIATE_TEST_SUITE_P(Slopes, Wedge,
                         testing::Values(Slope{0, 0.1, -0.1}, Slope{-12.5, -0.11906, -0.32899}));

TEST(Wedge, FrictionComesBackOutOfTheFormula) {
  for (const double degrees : {14.0, -12.5})
    for (const double mu : {0.02, 0.1, 0.6}) {
      const double a = degrees * std::numbers::pi / 180;
      const double up = wedge::uphill(1, 0, mu, a), down = wedge::downhill(1, 0, mu, a);
      EXPECT_NEAR(*wedge::friction((up - down) / 2, (up + down) / 2, a), mu, 1e-12);
    }
}

TEST(AfmContact, AFrictionlessSlopeOfOnePushesAsMuchSidewaysAsUp) {
  const AfmHistory h = history_of(shipped_afm("incline-frictionless.toml"));
  const std::size_t last = h.rows.size() - 1;
  const double up = h.value(last, "probe/force_z");
  EXPECT_GT(up, 1e-8);
  EXPECT_NEAR(-h.value(last, "probe/force_y") / up, 1, 1e-9);
  // The clamp, on the other side of the lever, feels the same.
  EXPECT_NEAR(h.value(last, "clamp/force_y") / up, 1, 1e-6);
  EXPECT_NEAR(-h.value(last, "clamp/force_z") / up, 1, 1e-6);
}

// The press drives the tip along the lever, so it slides from the start, and friction turns from x to y
// while the sample is drawn along y. All the way the lever twists and bends as under a small lateral force;
// in the end the tip slides along y at mu L and nothing moves any more.
TEST(AfmContact, TheTipTwistsAndBendsItsLeverUntilItSlips) {
  const Scene scene = afm_scene(beam_on(R"([surface]
shape = "plane"
friction = 0.1
[[action]]
kind = "press"
force = "100 nN"
increments = 3
[[action]]
kind = "scan"
distance = "1 nm"
set_point = "force"
back = "no"
increments = 40
)"));
  AfmSimulation simulation(scene);
  const Calibration c = simulation.calibrate();
  AfmHistory h;
  simulation.run([&](double time, const std::vector<double>& row) {
    h.times.push_back(time);
    h.rows.push_back(row);
    return true;
  });
  const std::size_t begin = 3, last = h.rows.size() - 1;
  const auto change = [&](const char* series, std::size_t a, std::size_t b) {
    return h.value(b, series) - h.value(a, series);
  };
  const double moved = change("probe/displacement_y", begin, last);
  for (std::size_t i = begin + 1; i <= last; ++i) {
    const double force = change("probe/force_y", begin, i);
    const double end = change("probe/displacement_y", begin, i);
    EXPECT_NEAR(force / (c.lateral_stiffness * end), 1, 0.01) << i;
    EXPECT_NEAR(change("foot/displacement_y", begin, i) / end, c.bending_share, 0.02) << i;
  }
  // Sliding.
  EXPECT_NEAR(std::abs(h.value(last, "probe/force_y")), 10e-9, 1e-12);
  EXPECT_LT(std::abs(change("probe/displacement_y", last - 3, last)), 1e-3 * std::abs(moved));
}

}  // namespace
}  // namespace pulvis
