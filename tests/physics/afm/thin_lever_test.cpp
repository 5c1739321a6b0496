// Levers so thin, or so soft beside their tip, that the stiffness has lost their bending in double: the laws hold
// on in long double, and beyond that the run stops and says why.
#include <cmath>

#include "engine/run_failure.hpp"
#include "scenes/results/state_hash.hpp"
#include "systems/lever/solid_equations.hpp"
#include "tests/helpers/afm_run.hpp"
#include "tests/helpers/program.hpp"
#include "tests/helpers/wrong.hpp"

namespace pulvis {
namespace {

double beam_law(double modulus, double thickness) {
  return modulus * 50e-6 * std::pow(thickness / 440e-6, 3) / 4;
}

// 200 to 20,000 times longer than thick. (Thicker ones are no plates any more.) Kirchhoff's plate knows one
// thickness only: the ratio to the beam, 1.2% for the clamp that holds the width, stays the same.
TEST(ThinLever, ABeamOfAnyThicknessIsThatOfBeamTheory) {
  for (const double thickness : {2.2e-6, 220e-9, 45e-9, 30e-9, 22e-9}) {
    const Calibration c = calibration_of(
        tipless_beam(), {"lever.thickness=" + std::to_string(thickness * 1e9) + " nm"});
    EXPECT_NEAR(c.normal_stiffness / beam_law(200e9, thickness), 1.012, 0.003) << thickness;
    EXPECT_LT(c.imbalance, 1e-6) << thickness;
    EXPECT_LT(c.error, 1e-6) << thickness;
    EXPECT_TRUE(c.stable) << thickness;
  }
}

// A load 1 um before the end: (440/439)^3 of the beam's.
TEST(ThinLever, ABeamWithATipIsThatOfBeamTheory) {
  for (const double nm : {45.0, 30.0}) {
    const Calibration c =
        calibration_of(coarse_beam, {"lever.thickness=" + std::to_string(nm) + " nm"});
    EXPECT_NEAR(c.normal_stiffness / beam_law(200e9, nm * 1e-9), 1.012 * std::pow(440 / 439., 3),
                0.005)
        << nm;
    EXPECT_NEAR(c.normal.clamp_moment.y() / 439e-6, 1, 1e-5) << nm;
  }
}

TEST(ThinLever, TheThinVAgreesWithNeumeisterAndDucker) {
  const Scene scene =
      shipped_afm("calibration-v.toml", {"lever.thickness=10 nm", "lever.side_aspect=100",
                                         "lever.foot_edge=0.5", "lever.foot_layers=0"});
  const Calibration c = AfmSimulation(scene, 2).calibrate();
  EXPECT_NEAR(c.normal_stiffness / c.closed_forms[0].value, 1, 0.01);
}

// Ten million times: under a tip of 10 TPa nothing but the lever bends, whatever it is made of.
TEST(ThinLever, StiffnessFollowsYoungsModulusFromRubberToBeyondDiamond) {
  // As the stiffness of the last one is: only the lever bends.
  const double last =
      calibration_of(coarse_beam, {"material.lever.youngs_modulus=200 GPa"}).normal_stiffness;
  for (const auto& [text, modulus] : {std::pair{"10 kPa", 1e4},
                                      {"1 MPa", 1e6},
                                      {"100 MPa", 1e8},
                                      {"10 GPa", 1e10},
                                      {"200 GPa", 2e11},
                                      {"1 TPa", 1e12}}) {
    const Calibration c =
        calibration_of(coarse_beam, {std::string("material.lever.youngs_modulus=") + text});
    EXPECT_NEAR(c.normal_stiffness / modulus, last / 200e9, 1e-5 * last / 200e9) << text;
    EXPECT_LT(c.error, 1e-6) << text;
  }
}

// A tip softer than the lever bends in the lever's place, but what has converged in double stays there.
TEST(ThinLever, WhatConvergesInDoubleStaysInDouble) {
  EXPECT_FALSE(calibration_of(coarse_beam).extended);
  EXPECT_FALSE(calibration_of(coarse_beam, {"lever.thickness=220 nm"}).extended);
  EXPECT_TRUE(calibration_of(coarse_beam, {"lever.thickness=45 nm"}).extended);
}

TEST(ThinLever, BeyondLongDoubleTheRunStopsAndSaysWhy) {
  const std::string what =
      message_of<RunFailure>([] { calibration_of(tipless_beam(), {"lever.thickness=1 nm"}); });
  EXPECT_NE(what.find("4.4e+05 times longer than thick"), std::string::npos) << what;
  EXPECT_NE(what.find("allowed: 1e-06"), std::string::npos) << what;
}

Scene thin_loop() {
  return afm_scene(
      std::string(beam_with_tip) + inclined_plane(14, 0.1) + press_and_scan(6),
      {"lever.foot_edge=0.5", "lever.thickness=30 nm", "action[0].force=1 pN",
       "action[1].distance=200 nm", "lever.elements_along=20", "lever.elements_across=4"});
}

// Equilibria of such a lever, with friction: Newton's method has the same factors.
TEST(ThinLever, ALoopOfALever15000TimesLongerThanThickDrawsWithTheForcesOfTheFormula) {
  const Scene scene = thin_loop();
  const FrictionLoop loop = friction_loops(scene, history_of(scene)).front();
  EXPECT_NEAR(loop.half_width / loop.load, 0.106283, 0.005 * 0.106283);
  EXPECT_NEAR(loop.offset / loop.load, 0.251978, 0.005 * 0.251978);
}

TEST(ThinLever, TheBitsAreThoseOfOneThread) {
  const auto hash = [](int threads) {
    const Scene scene = thin_loop();
    AfmSimulation simulation(scene, threads);
    history_of(simulation);
    return state_hash(simulation.world());
  };
  EXPECT_EQ(hash(3), hash(1));
}

// A resumed run makes its factors from them again.
TEST(ThinLever, ACheckpointHoldsEveryDigitOfTheStiffness) {
  const Scene scene = thin_loop();
  AfmSimulation simulation(scene);
  ASSERT_TRUE(simulation.calibrate().extended);
  auto& equations = simulation.world().resource<SolidEquations>();
  const Eigen::VectorXd force =
      Eigen::VectorXd::Ones(std::ssize(equations.extended.factors->pivots()));
  const Eigen::VectorXd before = equations.solve(force);
  equations.factorise_again(equations.factorised());
  EXPECT_EQ(equations.solve(force), before);
}

using ThinLeverProgram = ProgramTest;

TEST_F(ThinLeverProgram, StopsWithTheReasonAndKeepsItInTheSummary) {
  const Outcome run = pulvis(
      {"run", scene("afm/tipless-beam.toml"), "-o", "thin", "--set", "lever.thickness=1 nm"});
  EXPECT_EQ(run.code, 3) << run.err;
  EXPECT_NE(run.err.find("the run failed: calibration: "), std::string::npos) << run.err;
  const std::string summary = text_of(place / "thin" / "summary.json");
  EXPECT_NE(summary.find("\"outcome\": \"failed: calibration: "), std::string::npos) << summary;
  EXPECT_EQ(summary.find("\"k_n\":"), std::string::npos) << summary;
}

}  // namespace
}  // namespace pulvis
