// Tips pulled off planes, drawn over bumps and maps.
#include <cmath>
#include <numbers>

#include "engine/run_failure.hpp"
#include "scenes/lever/afm_curve.hpp"
#include "scenes/lever/afm_image.hpp"
#include "tests/helpers/afm_run.hpp"
#include "tests/helpers/experiment.hpp"
#include "tests/helpers/wrong.hpp"

namespace pulvis {
namespace {

// Pull-off at the adhesion, snap-in where attraction gets steeper than the lever.
TEST(ForceCurve, TheTipLeavesWhereTheLeverDrawsWithTheAdhesion) {
  const Scene scene = shipped_afm("force-curve.toml");
  AfmSimulation simulation(scene);
  const double k = simulation.calibrate().normal_stiffness;
  const AfmHistory h = history_of(scene);
  double minimum = 0, snapped_at = 0;
  for (std::size_t i = 1; i < h.rows.size(); ++i) {
    minimum = std::min(minimum, h.value(i, "probe/force_z"));
    const bool in = h.times[i] > 1 && h.times[i] < 3 && h.value(i, "contact/points") > 0;
    if (in && snapped_at == 0) snapped_at = h.value(i, "scanner/z");
  }
  EXPECT_NEAR(minimum / -20e-9, 1, 0.005);
  // The lever snaps on where d/dg [A/(1 + g/r)^2] = -k: the gap there, less how far the tip is drawn by then.
  const double stretch = std::cbrt(2 * 20e-9 / (k * 1e-9));
  const double expected = -1e-9 * (stretch - 1) - 20e-9 / (stretch * stretch) / k;
  EXPECT_GT(snapped_at, expected - 1e-11);
  EXPECT_LT(snapped_at, expected + 1e-9);  // an increment
  // Of the lever, A^2/2k; steps of finite length lose some of it.
  const double stored = 20e-9 * 20e-9 / (2 * k);
  const std::size_t pressed = 4 + 3 + 40 + 1;  // the row before the tip is retracted
  const double released = last(h, "energy/released") - h.value(pressed, "energy/released");
  EXPECT_GT(released, 0.8 * stored);
  EXPECT_LT(released, stored);
  EXPECT_NEAR(last(h, "clamp/force_z"), -last(h, "probe/force_z"), 1e-12);
  const std::vector<ForceCurveFigures> curves = force_curves(scene, h);
  ASSERT_EQ(curves.size(), 1u);
  EXPECT_TRUE(curves[0].released);
  EXPECT_EQ(curves[0].action, 4);  // not the first one: no press comes before it
  EXPECT_NEAR(curves[0].pull_off / 20e-9, 1, 0.005);
  EXPECT_NEAR(curves[0].work / stored, 1, 0.005);
  EXPECT_NEAR(*curves[0].work_of_adhesion, curves[0].pull_off / (2 * std::numbers::pi * 20e-9),
              1e-12);
}

// The same curve with a pause in the middle is one curve; one that stops in contact has no pull-off.
TEST(ForceCurve, GoesOnAfterAHoldAndEndsReleased) {
  const auto curves_of = [](const std::string& retractions) {
    const Scene scene = own_scene(
        "extends = \"afm/force-curve.toml\"\nremove = [\"expect\"]\naction = [{ kind = \"press\", "
        "distance = \"30 nm\", increments = 2 }, " +
        retractions + "]\n");
    return force_curves(scene, history_of(scene));
  };
  const auto paused = curves_of(
      "{ kind = \"retract\", distance = \"60 nm\", increments = 3 }, { kind = \"hold\", "
      "increments = 1 }, "
      "{ kind = \"retract\", distance = \"340 nm\", increments = 20 }");
  ASSERT_EQ(paused.size(), 1u);
  EXPECT_TRUE(paused[0].released);
  EXPECT_NEAR(paused[0].pull_off / 20e-9, 1, 1e-3);
  const auto stopped = curves_of("{ kind = \"retract\", distance = \"60 nm\", increments = 3 }");
  ASSERT_EQ(stopped.size(), 1u);
  EXPECT_FALSE(stopped[0].released);
}

// On coarse meshes: the laws hold on any.
const std::vector<std::string> v_on_plates{"lever.side_aspect=100", "lever.foot_edge=0.5",
                                           "lever.foot_layers=0"};
const std::vector<std::string> uniform_beam{"lever.elements_along=10", "lever.elements_across=4"};

Scene curve_in(const std::string& base, const std::vector<std::string>& mesh,
               const std::string& press, const std::string& retract) {
  return own_scene("extends = \"" + base + "\"\nremove = [\"expect\"]\naction = [" +
                       "{ kind = \"press\", " + press + " }, { kind = \"retract\", " + retract +
                       " }]\n",
                   mesh);
}

// The lever stretches until it pulls with the adhesion, however far apart the samples are.
TEST(ForceCurve, PullOffAndWorkDoNotDependOnTheIncrements) {
  for (const char* increments : {"4", "30"}) {
    const Scene scene =
        curve_in("afm/force-curve.toml", v_on_plates, "distance = \"30 nm\", increments = 2",
                 std::string("distance = \"400 nm\", increments = ") + increments);
    AfmSimulation simulation(scene);
    const double k = simulation.calibrate().normal_stiffness;
    const AfmHistory h = history_of(simulation);
    const std::vector<ForceCurveFigures> curves = force_curves(scene, h);
    ASSERT_EQ(curves.size(), 1u);
    EXPECT_NEAR(curves[0].pull_off / 20e-9, 1, 1e-3) << increments;
    const double stored = 20e-9 * 20e-9 / (2 * k);
    EXPECT_NEAR(curves[0].work / stored, 1, 5e-3) << increments;
    EXPECT_GT(last(h, "energy/released"), 0.8 * stored) << increments;
    EXPECT_LT(last(h, "energy/released"), stored) << increments;
  }
}

TEST(ForceCurve, AnElasticBallsPullOffDoesNotDependOnTheIncrements) {
  for (const char* increments : {"3", "30"}) {
    const Scene scene =
        curve_in("afm/jkr-force-curve.toml", uniform_beam, "distance = \"40 nm\", increments = 2",
                 std::string("distance = \"1.5 um\", increments = ") + increments);
    const AfmHistory h = history_of(scene);
    EXPECT_EQ(h.value(0, "contact/points"), 0);
    const std::vector<ForceCurveFigures> curves = force_curves(scene, h);
    ASSERT_EQ(curves.size(), 1u);
    EXPECT_TRUE(curves[0].released);
    EXPECT_NEAR(curves[0].pull_off / (1.5 * std::numbers::pi * 0.01 * 5e-6), 1, 1e-3) << increments;
    EXPECT_NEAR(*curves[0].work_of_adhesion / 0.01, 1, 1e-3) << increments;
  }
}

// At the start the attraction is balanced by the contact: the first retraction pulls on it.
TEST(ForceCurve, ATipThatJustTouchesIsHeldByItsAdhesion) {
  const Scene scene = own_scene(
      "extends = \"afm/force-curve.toml\"\nremove = [\"expect\"]\naction = [{ kind = "
      "\"retract\", distance = \"10 nm\", increments = 1 }]\n",
      v_on_plates);
  AfmSimulation simulation(scene);
  const double k = simulation.calibrate().normal_stiffness;
  const AfmHistory h = history_of(simulation);
  EXPECT_EQ(h.value(0, "contact/points"), 1);
  EXPECT_EQ(last(h, "contact/points"), 1);
  EXPECT_NEAR(last(h, "probe/force_z") / (-k * 10e-9), 1, 0.005);
}

// Above the sample there is neither a force to hold nor a loop.
TEST(ForceCurve, AProbeOffTheSampleHasNoForceToHoldAndNoLoop) {
  const auto scanned = [](const std::string& keys) {
    return own_scene(
        "extends = \"afm/force-curve.toml\"\nremove = [\"expect\"]\nsurface = { shape = "
        "\"plane\", friction = 0.2, pull_off = \"0 N\" }\naction = [{ kind = \"press\", distance = "
        "\"-50 nm\", "
        "increments = 1 }, { kind = \"scan\", distance = \"8 nm\", increments = 4" +
            keys + " }]\n",
        v_on_plates);
  };
  const std::string what =
      message_of<RunFailure>([&] { history_of(scanned(", set_point = \"force\"")); });
  EXPECT_NE(what.find("action[1]: the probe does not touch the sample"), std::string::npos) << what;
  const Scene open = scanned("");
  const std::vector<FrictionLoop> loops = friction_loops(open, history_of(open));
  ASSERT_EQ(loops.size(), 1u);
  EXPECT_EQ(loops[0].touches, 0);
  EXPECT_EQ(loops[0].needed, 0);
  EXPECT_FALSE(loops[0].full());
}

TEST(ForceCurve, AProgrammeWithoutAPressHasNone) {
  EXPECT_FALSE(has_force_curve(shipped_afm("raster.toml")));
  EXPECT_TRUE(has_force_curve(shipped_afm("jkr-force-curve.toml")));
}

// The tip follows a slope of 0.5 with the force of the formula, from the foot of a bump on.
TEST(ForceCurve, ABumpIsClimbedWithTheForceOfTheFormula) {
  const AfmHistory h = history_of(shipped_afm("bump.toml"));
  const double up = wedge::uphill(1, 0, 0.1, std::atan(0.5));
  int on_flank = 0;
  for (std::size_t i = 20; i < h.rows.size(); ++i) {
    EXPECT_NEAR(h.value(i, "probe/force_z"), 100e-9, 1e-13) << i;
    EXPECT_NEAR(h.value(i, "clamp/force_y") / -h.value(i, "probe/force_y"), 1, 1e-4) << i;
    if (std::abs(-h.value(i, "probe/force_y") / 100e-9 / up - 1) < 0.005) ++on_flank;
  }
  EXPECT_GT(on_flank, 20);
  EXPECT_NEAR(-last(h, "probe/force_y") / 100e-9 / up, 1, 0.005);
}

// A rigid tip under a kept force over an inclined map: the topography is the plane.
TEST(Raster, TheTopographyIsTheSurface) {
  const Scene scene = shipped_afm(
      "raster.toml",
      {"action[3].lines=3", "action[3].increments=6", "action[3].distance=120 nm",
       "action[3].width=40 nm", "surface.friction=0", "action[1].distance=-100 nm",
       "action[1].increments=5", "action[2].distance=-100 nm", "action[2].increments=5"});
  const AfmHistory h = history_of(scene);
  const auto images = raster_images(scene, h);
  ASSERT_EQ(images.size(), 6u);
  const AfmImage &trace = images[0], &retrace = images[1];
  EXPECT_EQ(trace.info.name, "action_3/topography_trace");
  ASSERT_EQ(trace.values.size(), 18u);
  EXPECT_NEAR(trace.spacing.along, 20e-9, 1e-20);
  EXPECT_NEAR(trace.spacing.across, 20e-9, 1e-20);
  // Without friction the retrace is the trace.
  for (std::size_t i = 0; i < 18; ++i) EXPECT_NEAR(retrace.values[i], trace.values[i], 2e-12) << i;
}

// Law: on a slope t, (T_u - T_d)/2 = mu L/(cos^2 t - mu^2 sin^2 t), docs/afm.md: mu L but for t^2.
TEST(Raster, HalfTheDifferenceIsFrictionWithoutTheSlopes) {
  for (const std::string distance : {"160 nm", "-160 nm"}) {
    SCOPED_TRACE(distance);
    const Scene scene =
        shipped_afm("raster.toml", {"action[3].lines=2", "action[3].increments=8",
                                    "action[3].distance=" + distance, "action[3].width=40 nm",
                                    "action[1].distance=-300 nm", "action[1].increments=5",
                                    "action[2].increments=5"});
    const auto images = raster_images(scene, history_of(scene));
    const AfmImage &trace = images[4], &retrace = images[5];
    ASSERT_EQ(trace.info.name, "action_3/friction_trace");
    double sum = 0, least = 1, most = -1, slopes = 0;
    for (std::size_t i = 0; i < trace.values.size(); ++i) {
      const double half = 0.5 * (trace.values[i] - retrace.values[i]);
      sum += half / static_cast<double>(trace.values.size());
      least = std::min(least, half);
      most = std::max(most, half);
      slopes = std::max(slopes, std::abs(trace.values[i] + retrace.values[i]) / 2);
    }
    EXPECT_GT(least, 0.97 * sum);
    EXPECT_LT(most, 1.03 * sum);
    EXPECT_GT(slopes, 0.1 * sum);  // there are some
    EXPECT_GT(sum, 0);
  }
}

}  // namespace
}  // namespace pulvis
