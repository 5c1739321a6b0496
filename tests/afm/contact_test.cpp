// A tip against surfaces: Coulomb's law, wedges, the order of twist, bending and slip, pull-off.
#include <cmath>
#include <numbers>

#include "scenes/afm_figures.hpp"
#include "scenes/afm_loop.hpp"
#include "systems/run_failure.hpp"
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
                         testing::Values(Slope{0, 0.1, -0.1}, Slope{14.0, 0.35826, 0.14570},
                                         Slope{-12.5, -0.11906, -0.32899}));

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

// While the tip sticks the lever twists and bends as it does under a small lateral force; then it slips at
// mu L and nothing moves any more.
TEST(AfmContact, TwistAndBendingComeFirstThenSlip) {
  const Scene scene = afm_scene(beam_on(R"([surface]
shape = "plane"
friction = 0.1
[[action]]
kind = "press"
force = "100 nN"
increments = 3
[[action]]
kind = "scan"
distance = "0.4 nm"
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
  std::size_t slip = begin;
  while (slip < last && h.value(slip, "contact/slides") == 0) ++slip;
  ASSERT_GT(slip, begin + 4);
  ASSERT_LT(slip, last - 4);
  const auto change = [&](const char* series, std::size_t a, std::size_t b) {
    return h.value(b, series) - h.value(a, series);
  };
  // Sticking: the sample carries the tip along with it against the lever's lateral stiffness.
  const double moved = change("scanner/y", begin, slip - 1);
  EXPECT_NEAR(change("probe/force_y", begin, slip - 1) / (c.lateral_stiffness * moved), 1, 0.01);
  EXPECT_NEAR(change("foot/displacement_y", begin, slip - 1) /
                  change("probe/displacement_y", begin, slip - 1),
              c.bending_share, 0.02);
  // Sliding.
  EXPECT_NEAR(std::abs(h.value(last, "probe/force_y")), 10e-9, 1e-12);
  EXPECT_LT(std::abs(change("probe/displacement_y", last - 3, last)), 1e-3 * std::abs(moved));
}

// No force inside, none outside: the sum of the clamp's and the sample's forces is nothing at all times.
TEST(AfmContact, TheClampHoldsWhatTheSampleDoes) {
  const AfmHistory h = history_of(shipped_afm("bump-v.toml", {"action[1].increments=40"}));
  for (std::size_t i = 0; i < h.rows.size(); ++i)
    for (const char* axis : {"x", "y", "z"}) {
      const double sample = h.value(i, std::string("probe/force_") + axis);
      EXPECT_NEAR(h.value(i, std::string("clamp/force_") + axis), -sample, 1e-12);
    }
}

TEST(AfmContact, OnTheFlankOfABumpTheForcesAreThoseOfItsSlope) {
  const AfmHistory h = history_of(shipped_afm("bump-v.toml"));
  bool flank = false;
  for (std::size_t i = 0; i < h.rows.size(); ++i) {
    const double ratio = -h.value(i, "probe/force_y") / h.value(i, "probe/force_z");
    // Going up a slope of 0.5 with mu = 0.1: (s + mu)/(1 - mu s).
    if (h.value(i, "contact/slides") > 0 && std::abs(ratio - 0.6 / 0.95) < 1e-3) flank = true;
    EXPECT_LT(ratio, 0.6 / 0.95 + 1e-3);
  }
  EXPECT_TRUE(flank);
}

// The same numbers, to the last bit, with one thread and with three.
TEST(AfmContact, NothingDependsOnTheThreads) {
  const Scene scene = afm_scene(
      beam_on(std::string("[surface]\nshape = \"plane\"\nfriction = 0.1\nincline = \"14 deg\"\n") +
              press_and_loop));
  EXPECT_EQ(history_of(scene, 1).rows, history_of(scene, 3).rows);
}

TEST(AfmContact, ATipThatLocksIsReported) {
  const Scene scene = afm_scene(beam_on(R"([surface]
shape = "step"
height = "10 um"
slope = 20
position = "5 nm"
friction = 1
[[action]]
kind = "press"
force = "100 nN"
[[action]]
kind = "scan"
distance = "20 nm"
set_point = "force"
back = "no"
)"));
  AfmSimulation simulation(scene);
  try {
    simulation.run([](double, const std::vector<double>&) { return true; });
    FAIL() << "a slope of 20 with friction 1 holds the tip: no height keeps its force";
  } catch (const RunFailure& failure) {
    EXPECT_NE(std::string(failure.what()).find("no equilibrium"), std::string::npos);
  }
}

// The pull-off force is the adhesion that was put in, reached where the lever is softer than the bond.
TEST(AfmContact, ASlowPullOffTakesTheAdhesionForce) {
  const Scene scene = afm_scene(beam_on(R"([surface]
shape = "plane"
pull_off = "10 nN"
adhesion_range = "1 um"
[[action]]
kind = "press"
distance = "20 nm"
[[action]]
kind = "retract"
distance = "200 nm"
increments = 100
)"));
  const AfmHistory h = history_of(scene);
  double least = 0;
  for (std::size_t i = 0; i < h.rows.size(); ++i)
    least = std::min(least, h.value(i, "probe/force_z"));
  EXPECT_NEAR(least, -10e-9, 0.02 * 10e-9);
}

}  // namespace
}  // namespace pulvis
