// A tip against surfaces: Coulomb's law, wedges, the order of twist, bending and slip, pull-off.
#include <cmath>
#include <numbers>

#include "engine/run_failure.hpp"
#include "scenes/lever/afm_figures.hpp"
#include "tests/helpers/afm_run.hpp"
#include "tests/helpers/wrong.hpp"

namespace pulvis {
namespace {

std::string on_incline(const std::string& lever, double degrees, double friction) {
  return lever + inclined_plane(degrees, friction) + press_and_scan(20);
}

struct Slope {
  const char* lever;
  double degrees, friction;
};

class Wedge : public testing::TestWithParam<Slope> {};

TEST_P(Wedge, AStiffTipDrawsWithTheForcesOfTheFormula) {
  const Slope& slope = GetParam();
  const Scene scene = afm_scene(on_incline(slope.lever, slope.degrees, slope.friction));
  const FrictionLoop loop = friction_loops(scene, history_of(scene)).front();
  const double angle = slope.degrees * std::numbers::pi / 180;
  const double up = wedge::uphill(1, 0, slope.friction, angle);
  const double down = wedge::downhill(1, 0, slope.friction, angle);
  EXPECT_NEAR(loop.load, 100e-9, 1e-14);
  EXPECT_NEAR(loop.trace / loop.load, up, 0.005 * std::abs(up));
  EXPECT_NEAR(loop.retrace / loop.load, down, 0.005 * std::abs(down));
  if (slope.degrees == 0) return;
  ASSERT_TRUE(loop.friction);  // from volts alone
  EXPECT_NEAR(*loop.friction, slope.friction, 0.02 * slope.friction);
}

INSTANTIATE_TEST_SUITE_P(Beam, Wedge,
                         testing::Values(Slope{coarse_beam, 0, 0.1}, Slope{coarse_beam, -12.5, 0.1},
                                         Slope{coarse_beam, 14, 0.1}, Slope{coarse_beam, 30, 0.4}));
INSTANTIATE_TEST_SUITE_P(V, Wedge,
                         testing::Values(Slope{coarse_v, 0, 0.1}, Slope{coarse_v, -12.5, 0.1},
                                         Slope{coarse_v, 14, 0.1}));

TEST(Wedge, ThreadsChangeNoBit) {
  const Scene scene = afm_scene(on_incline(coarse_v, 14, 0.1));
  const AfmHistory one = history_of(scene, 1);
  for (const int threads : {2, 3}) EXPECT_EQ(history_of(scene, threads).rows, one.rows) << threads;
}

// On a slope of 1 a coefficient of 1 holds against any force uphill: a longer way only presses harder.
TEST(Wedge, AProbeThatLocksIsReported) {
  const Scene scene = afm_scene(on_incline(coarse_beam, 45, 1));
  const std::string what = message_of<RunFailure>([&] { history_of(scene); });
  EXPECT_NE(what.find("scan: the probe has locked"), std::string::npos) << what;
  EXPECT_NE(what.find("allowed: < 1"), std::string::npos) << what;
}

// Just below that the formula still holds: T_u/L = (1 + mu)/(1 - mu).
TEST(Wedge, AProbeThatHardlySlidesUphillStillDoes) {
  const Scene scene = afm_scene(on_incline(coarse_beam, 45, 0.9), {"action[1].distance=60 nm"});
  const FrictionLoop loop = friction_loops(scene, history_of(scene)).front();
  EXPECT_NEAR(loop.trace / loop.load, 19, 0.1);
  EXPECT_NEAR(loop.retrace / loop.load, 1 / 19.0, 0.001);
}

// A lever drawn by less than what friction of 1 holds it back (1.4 nm each way): the loop is told, and no friction
// is read out of it.
TEST(Wedge, ALoopOfAProbeThatSticksGivesNoFriction) {
  const auto loop_of = [](const char* distance) {
    const Scene scene =
        afm_scene(on_incline(coarse_beam, 14, 1), {std::string("action[1].distance=") + distance});
    return friction_loops(scene, history_of(scene)).front();
  };
  const FrictionLoop sticks = loop_of("4 nm"), slides = loop_of("20 nm");
  EXPECT_LT(sticks.slides, 0.9);
  EXPECT_FALSE(sticks.friction);
  EXPECT_FALSE(sticks.sensitivity);
  EXPECT_GT(slides.slides, 1 - 1e-3);
  EXPECT_NEAR(slides.half_width / slides.load, 1.13257, 0.005 * 1.13257);
}

// A soft, tilted lever: its press leaves friction along the lever, and a short scan turns it only in part. The probe
// slides all the while. What the program asks for instead is enough.
TEST(Wedge, ALoopWhoseFrictionHasNotTurnedGivesNoneAndTheScanThatWould) {
  for (const auto& [tilt, degrees, mu] : {std::tuple{12, 30, 0.5}, {12, 14, 0.2}}) {
    const auto loop_of = [&, d = degrees, m = mu, t = tilt](double distance) {
      const Scene scene = afm_scene(
          on_incline(coarse_beam, d, m),
          {"lever.thickness=0.5 um", "lever.aspect=44", "material.lever.youngs_modulus=20 GPa",
           "lever.tilt=" + std::to_string(t) + " deg", "action[0].force=1 nN",
           "action[1].distance=" + std::to_string(1e9 * distance) + " nm"});
      return friction_loops(scene, history_of(scene)).front();
    };
    const FrictionLoop first = loop_of(100e-9);
    EXPECT_FALSE(first.full()) << degrees;
    EXPECT_FALSE(first.friction) << degrees;
    EXPECT_FALSE(first.sensitivity) << degrees;
    EXPECT_GT(first.needed, 100e-9) << degrees;
    FrictionLoop then = loop_of(first.needed);
    // The first scan may have told nothing but that it sticks.
    if (!then.full()) then = loop_of(then.needed);
    EXPECT_TRUE(then.full()) << degrees << ' ' << then.needed;
    EXPECT_NEAR(then.friction.value_or(0) / mu, 1, 0.01) << degrees;
  }
}

// At a kept height the load grows uphill: one way's half is pressed harder than the other's.
TEST(Wedge, ALoopWhoseLoadDriftsGivesNoFriction) {
  std::string text = on_incline(coarse_beam, 14, 0.1);
  const auto kept = text.find("set_point = \"force\"\n");
  ASSERT_NE(kept, std::string::npos);
  text.erase(kept, std::string("set_point = \"force\"\n").size());
  const Scene scene = afm_scene(text, {"action[1].distance=200 nm"});
  const FrictionLoop loop = friction_loops(scene, history_of(scene)).front();
  EXPECT_GT(loop.slides, 1 - 1e-3);
  EXPECT_GT(loop.drift, 0.01);
  EXPECT_FALSE(loop.friction);
}

// As one of two roots, whose product is 1/(1 + a/cos theta): which of the two, the ratio Delta/W does not tell.
TEST(Wedge, FrictionComesBackOutOfTheFormula) {
  for (const double degrees : {14.0, -12.5, 5.0})
    for (const double mu : {0.01, 0.02, 0.1, 0.6, 0.95, 1.3, 2.0, 3.0})
      for (const double adhesion : {0.0, 0.5}) {
        const double a = degrees * std::numbers::pi / 180;
        const double up = wedge::uphill(2, 2 * adhesion, mu, a),
                     down = wedge::downhill(2, 2 * adhesion, mu, a);
        const auto roots = wedge::friction((up - down) / 2, (up + down) / 2, a, adhesion);
        ASSERT_TRUE(roots && roots->upper) << degrees << ' ' << mu << ' ' << adhesion;
        const double product = 1 / (1 + adhesion / std::cos(a));
        EXPECT_NEAR(roots->lower * *roots->upper / product, 1, 1e-12);
        EXPECT_NEAR((mu * mu < product ? roots->lower : *roots->upper) / mu, 1, 1e-11);
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
  const Scene scene = afm_scene(std::string(coarse_beam) + R"([surface]
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
retrace = "no"
increments = 40
)");
  AfmSimulation simulation(scene);
  const Calibration c = simulation.calibrate();
  const AfmHistory h = history_of(simulation);
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

// At the turn of a level loop the tip sticks, the lever twists and bends sideways in the shares that the
// calibration has, and when the force has gone from mu L to -mu L the tip slips and nothing moves more.
class Turn : public testing::TestWithParam<const char*> {};

TEST_P(Turn, TwistsAndBendsTheLeverUntilTheTipSlips) {
  const Scene scene = afm_scene(on_incline(GetParam(), 0, 0.1));
  AfmSimulation simulation(scene);
  const Calibration c = simulation.calibrate();
  const AfmHistory h = history_of(scene);
  const std::size_t turn = 23, end = h.rows.size() - 1;
  ASSERT_EQ(h.value(turn, "contact/slides"), 1);
  std::size_t slip = turn + 1;
  while (slip <= end && h.value(slip, "contact/slides") == 0) ++slip;
  ASSERT_GT(slip, turn + 1);
  ASSERT_LT(slip, end);
  const auto change = [&](const char* series, std::size_t to) {
    return h.value(to, series) - h.value(turn, series);
  };
  for (std::size_t i = turn + 1; i < slip; ++i) {
    const double moved = change("probe/displacement_y", i);
    EXPECT_NEAR(change("foot/displacement_y", i) / moved, c.bending_share, 0.01) << i;
    EXPECT_NEAR(c.arm * change("foot/twist", i) / moved, c.twist_share, 0.01) << i;
    // The load has bent the lever: 1% more than the stiffness at rest.
    EXPECT_NEAR(change("probe/force_y", i) / moved / c.lateral_stiffness, 1, 0.02) << i;
  }
  for (std::size_t i = slip; i <= end; ++i) {
    EXPECT_EQ(h.value(i, "contact/slides"), 1) << i;
    EXPECT_NEAR(std::abs(h.value(i, "probe/force_y")), 10e-9, 1e-12) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(BeamAndV, Turn, testing::Values(coarse_beam, coarse_v));

}  // namespace
}  // namespace pulvis
