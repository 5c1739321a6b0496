// Levers, balls and coefficients far from the usual: the laws hold on.
#include "tests/helpers/afm_run.hpp"

namespace pulvis {
namespace {

void expect_the_formula(const std::string& lever, const std::vector<std::string>& overrides) {
  const Scene scene = afm_scene(lever + inclined_plane(14, 0.1) + press_and_scan(8), overrides);
  const FrictionLoop loop = friction_loops(scene, history_of(scene)).front();
  EXPECT_NEAR(loop.half_width / loop.load, 0.106283, 0.005 * 0.106283);
  EXPECT_NEAR(loop.offset / loop.load, 0.251978, 0.005 * 0.251978);
}

// 1,150 times longer than thick.
TEST(AfmExtremes, ALeverOfATenthOfAMicrometreDrawsWithTheForcesOfTheFormula) {
  expect_the_formula(coarse_v,
                     {"lever.thickness=0.1 um", "lever.aspect=57", "action[0].force=0.1 nN"});
}

TEST(AfmExtremes, ALeverOfTenMicrometresDrawsWithTheForcesOfTheFormula) {
  expect_the_formula(coarse_beam, {"lever.thickness=10 um"});
}

// As stiff as the lever, a thousand times stiffer and softer: each presses with the stiffness that it was
// calibrated to. The softest gives way by 0.3% of the way, the stiffest holds more of the lever's foot.
TEST(AfmExtremes, BallsAThousandTimesStifferAndSofterThanTheirLeverPressAsCalibrated) {
  double softer = 0;
  for (const char* modulus : {"10 MPa", "10 GPa", "10 TPa"}) {
    const Scene scene =
        shipped_afm("colloid-cu.toml", {"action[0].increments=4", "action[0].distance=0.1 um",
                                        "material.lever.youngs_modulus=10 GPa",
                                        std::string("material.Cu.youngs_modulus=") + modulus});
    const AfmHistory h = history_of(scene);
    const double f = last(h, "probe/force_z");
    const double k = AfmSimulation(scene).calibrate().normal_stiffness;
    EXPECT_NEAR(f / (k * 0.1e-6), 1, 1e-3) << modulus;
    EXPECT_NEAR(-last(h, "clamp/force_z") / f, 1, 1e-4) << modulus;
    EXPECT_GT(f, softer) << modulus;
    softer = f;
  }
}

}  // namespace
}  // namespace pulvis
