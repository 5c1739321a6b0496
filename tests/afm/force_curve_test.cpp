// Balls pressed on planes, and tips pulled off them.
#include <cmath>

#include "components/probe.hpp"
#include "components/solid.hpp"
#include "scenes/afm_image.hpp"
#include "tests/afm/afm_run.hpp"

namespace pulvis {
namespace {

// Hertz: a^3 = 3 F R/(4 E*), and the pressure's second moment is 2/5 a^2. The ball is softer than its lever
// and its mesh drawn together at the pole.
TEST(ForceCurve, ASoftBallTouchesAPlaneOverHertzsCircle) {
  const Scene scene = afm_scene(R"(family = "afm"
[[material]]
name = "lever"
youngs_modulus = "280 GPa"
poissons_ratio = 0.2
[[material]]
name = "soft"
youngs_modulus = "10 MPa"
poissons_ratio = 0.3
[lever]
shape = "beam"
material = "lever"
length = "100 um"
width = "30 um"
thickness = "3 um"
[tip]
shape = "sphere"
material = "soft"
radius = "5 um"
neck_radius = "3 um"
neck_height = "1 um"
set_back = "10 um"
elements = 8
focus = 2
[surface]
shape = "plane"
[[action]]
kind = "press"
distance = "0.1 um"
increments = 4
)");
  AfmSimulation simulation(scene);
  simulation.run([](double, const std::vector<double>&) { return true; });
  const World& world = simulation.world();
  const auto& force = world.column<ProbeForce>();
  const auto* node = world.column<ProbeNode>().values();
  const auto* x = world.column<ReferencePosition>().values();
  double sum = 0, moment = 0;
  const Vec3 pole(Vec3(x + 3 * simulation.model().end.front().node));
  for (std::size_t i = 0; i < force.table.rows; ++i) {
    const double f = force.values()[3 * i + 2];
    const Vec3 off = Vec3(x + 3 * node[i]) - pole;
    sum += f;
    moment += f * off.head<2>().squaredNorm();
  }
  const double measured = std::sqrt(2.5 * moment / sum);
  const double hertz = std::cbrt(0.75 * sum * 5e-6 * (1 - 0.09) / 10e6);
  EXPECT_GT(hertz, 0.4e-6);
  EXPECT_NEAR(measured / hertz, 1, 0.03);
}

// Pull-off at the adhesion, snap-in where attraction gets steeper than the lever.
TEST(ForceCurve, TheTipLeavesWhereTheLeverDrawsWithTheAdhesion) {
  const Scene scene = shipped_afm("force-curve.toml");
  AfmSimulation simulation(scene);
  const double k = simulation.calibrate().normal_stiffness;
  const AfmHistory h = history_of(scene);
  double least = 0, snapped_at = 0;
  for (std::size_t i = 1; i < h.rows.size(); ++i) {
    least = std::min(least, h.value(i, "probe/force_z"));
    const bool in = h.times[i] > 1 && h.times[i] < 2 && h.value(i, "contact/points") > 0;
    if (in && snapped_at == 0) snapped_at = h.value(i, "scanner/z");
  }
  EXPECT_NEAR(least / -20e-9, 1, 0.005);
  // The lever snaps on where d/dg [A/(1 + g/r)^2] = -k: the gap there, less how far the tip is drawn by then.
  const double stretch = std::cbrt(2 * 20e-9 / (k * 1e-9));
  const double expected = -1e-9 * (stretch - 1) - 20e-9 / (stretch * stretch) / k;
  EXPECT_NEAR(snapped_at / expected, 1, 0.1);
  EXPECT_GT(last(h, "energy/released"),
            0.5 * 20e-9 * 20e-9 / k * 0.9);  // of the lever, at the least
  EXPECT_NEAR(last(h, "clamp/force_z"), -last(h, "probe/force_z"), 1e-12);
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
      "raster.toml", {"action[3].lines=3", "action[3].increments=6", "action[3].distance=120 nm",
                      "action[3].width=40 nm", "surface.friction=0"});
  const AfmHistory h = history_of(scene);
  const auto images = raster_images(scene, h);
  ASSERT_EQ(images.size(), 6u);
  const AfmImage &forth = images[0], &back = images[1];
  EXPECT_EQ(forth.info.name, "action_3/topography_forth");
  ASSERT_EQ(forth.values.size(), 18u);
  // Without friction the way back is the way forth: a pixel's near end is the last one's far end.
  for (std::size_t line = 0; line < 3; ++line)
    for (std::size_t pixel = 1; pixel < 6; ++pixel)
      EXPECT_NEAR(back.values[6 * line + pixel], forth.values[6 * line + pixel - 1], 2e-12);
}

}  // namespace
}  // namespace pulvis
