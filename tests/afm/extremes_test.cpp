// Levers, balls and coefficients far from the usual: the laws hold on.
#include "tests/afm/afm_run.hpp"

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
  expect_the_formula(v_with_tip, {"lever.thickness=0.1 um", "action[0].force=0.1 nN"});
}

TEST(AfmExtremes, ALeverOfTenMicrometresDrawsWithTheForcesOfTheFormula) {
  expect_the_formula(beam_with_tip, {"lever.thickness=10 um"});
}

// As stiff as metal the ball adds nothing; a thousand times softer it still balances.
TEST(AfmExtremes, BallsOfMetalAndAThousandTimesSofterThanTheirLeverBalance) {
  const std::vector<std::string> less{"action[0].increments=4", "action[0].distance=0.1 um"};
  const auto force = [&](const char* modulus) {
    std::vector<std::string> overrides = less;
    overrides.push_back(std::string("material.Cu.youngs_modulus=") + modulus);
    const AfmHistory h = history_of(shipped_afm("colloid-cu.toml", overrides));
    const double f = last(h, "probe/force_z");
    EXPECT_NEAR(-last(h, "clamp/force_z") / f, 1, 1e-4) << modulus;
    return f;
  };
  const double metal = force("115 GPa");
  EXPECT_GT(force("0.28 GPa"), 0);
  const Scene scene = shipped_afm("colloid-cu.toml");
  const double k = AfmSimulation(scene).calibrate().normal_stiffness;
  EXPECT_NEAR(metal / (k * 0.1e-6), 1, 0.02);
}

}  // namespace
}  // namespace pulvis
