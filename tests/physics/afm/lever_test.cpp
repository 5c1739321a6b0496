// Levers against beam theory, the formula of Neumeister and Ducker, MacNeal and Harder's beams and Euler's
// elastica.
#include "tests/helpers/lever.hpp"

#include <cmath>
#include <numbers>

#include "components/solid.hpp"
#include "scenes/lever/mesh_error.hpp"

namespace pulvis {
namespace {

// Converged for L = 440 um, loaded at its very end: 0.3164 N/m, 1.2% above 3EI/L^3 because the clamp holds
// the lever's width too.
TEST(AfmLever, OneHexahedronThroughTheThicknessGivesTheBeamsStiffness) {
  const std::string text = tipless_beam();
  for (const char* aspect : {"lever.aspect=2", "lever.aspect=10"})
    EXPECT_NEAR(calibration_of(text, {aspect}).normal_stiffness / 0.3164, 1, 0.01) << aspect;
}

TEST(AfmLever, TheBeamsLateralStiffnessIsTwistAndLateralBending) {
  const Calibration c = calibration_of(beam_with_tip);
  EXPECT_NEAR(c.bending_share, 0.475, 0.005);
  EXPECT_NEAR(c.twist_share, 0.49, 0.01);
  EXPECT_NEAR(c.bending_share + c.twist_share + c.tip_share, 1, 1e-12);
  EXPECT_NEAR(c.arm, 13.7e-6, 1e-12);
}

// Converged with graded meshes of solid elements alone, of another program: the foot's local give and the layers at
// the sides that carry the torsion are in them.
TEST(AfmLever, TheLateralStiffnessIsWithinAPercentOfConvergedSolids) {
  const std::vector<std::string> at_the_end{"tip.height=13.7 um", "tip.foot=4 um",
                                            "tip.set_back=2 um"};
  std::vector<std::string> of_the_levers_own = at_the_end;
  of_the_levers_own.push_back("tip.material=lever");
  EXPECT_NEAR(calibration_of(beam_with_tip).lateral_stiffness / 76.46, 1, 0.01);
  EXPECT_NEAR(calibration_of(beam_with_tip, at_the_end).lateral_stiffness / 73.9, 1, 0.01);
  EXPECT_NEAR(calibration_of(beam_with_tip, of_the_levers_own).lateral_stiffness / 72.6, 1, 0.01);
  const Scene v = shipped_afm("calibration-v.toml");
  EXPECT_NEAR(AfmSimulation(v).calibrate().lateral_stiffness / 91.8, 1, 0.01);
}

// Half a thickness, and a quarter of the width: against meshes twice as fine everywhere.
TEST(AfmLever, FeetOfAnySizeGiveWayAsOnAFineMesh) {
  for (const auto& [foot, back] : {std::pair{"1.1 um", "1 um"}, {"12.5 um", "10 um"}}) {
    const std::vector<std::string> tip{std::string("tip.foot=") + foot,
                                       std::string("tip.set_back=") + back};
    std::vector<std::string> fine = tip;
    fine.insert(fine.end(), {"lever.aspect=3", "lever.side_aspect=0.25", "lever.foot_edge=0.015"});
    const double usual = calibration_of(beam_with_tip, tip).lateral_stiffness;
    EXPECT_NEAR(usual / calibration_of(beam_with_tip, fine).lateral_stiffness, 1, 0.008) << foot;
  }
}

TEST(AfmLever, TheErrorOfTheMeshIsEstimated) {
  for (const char* mesh : {"lever.aspect=6", "lever.aspect=10"}) {
    const Scene scene = afm_scene(beam_with_tip, {mesh});
    const Calibration c = AfmSimulation(scene).calibrate();
    const double estimate = mesh_error(scene, c, 1)->lateral,
                 error = c.lateral_stiffness / 76.46 - 1;
    EXPECT_GT(estimate, 0.7 * error) << mesh;
    EXPECT_LT(estimate, 4 * error) << mesh;
  }
}

// Too coarse for the strips at its sides and for the rim of the foot, whether it is a little coarser or not.
TEST(AfmLever, TheErrorOfAUniformMeshIsEstimated) {
  const Scene scene =
      afm_scene(beam_with_tip, {"lever.elements_along=40", "lever.elements_across=4"});
  const Calibration c = AfmSimulation(scene).calibrate();
  const double error = c.lateral_stiffness / 76.46 - 1;
  EXPECT_GT(error, 0.02);
  EXPECT_NEAR(mesh_error(scene, c, 1)->lateral / error, 1, 0.4);
}

TEST(AfmLever, WhereTheFootStandsChangesTheMeshSmoothly) {
  // Square and round, on the axis and beside it, flush with the end: no jump from one mesh to another.
  double before = 0;
  for (const char* offset : {"0 um", "0.1 um", "0.2 um", "0.3 um"}) {
    const Scene scene = shipped_afm("calibration-v.toml", {std::string("tip.offset=") + offset});
    const double k = AfmSimulation(scene).calibrate().lateral_stiffness;
    if (before > 0) {
      EXPECT_NEAR(k / before, 1, 0.01) << offset;
    }
    before = k;
  }
}

TEST(AfmLever, TheClampHoldsWhatPressesOnTheTip) {
  const Calibration c = calibration_of(beam_with_tip);
  EXPECT_LT(c.imbalance, 1e-9);
  // Moment about the clamp: force at x = 439 um, 13.7 um under the middle plane.
  EXPECT_NEAR(c.normal.clamp_moment.y() / 439e-6, 1, 1e-5);
  EXPECT_NEAR(c.lateral.clamp_moment.z() / -439e-6, 1, 1e-5);
  EXPECT_NEAR(c.lateral.clamp_moment.x() / -13.7e-6, 1, 1e-3);
}

// Slope at the loaded end of a beam: 3/(2L) of its deflection.
TEST(AfmLever, TheSlopeAtTheEndIsThatOfABeam) {
  const Calibration c = calibration_of(beam_with_tip);
  const double slope = c.normal.spot.normal / c.normal.end.z();
  EXPECT_NEAR(slope * 439e-6 / 1.5, 1, 0.01);
}

// Loaded at a: slope (a x - x^2/2)/(a^3/3) per deflection of the load. Six positions lie in two elements. The clamp holds the
// width, too: two widths from it the slope is 1% less, on any mesh.
TEST(AfmLever, TheSlopeAtTheLaserSpotIsThatOfABeam) {
  const double end = 439e-6;
  double before = 0;
  for (const int x : {100, 203, 206, 209, 212, 215, 218, 300, 400}) {
    const Calibration c =
        calibration_of(beam_with_tip, {"laser.position=" + std::to_string(x) + " um"});
    const double slope = c.normal.spot.normal / c.normal.end.z(), at = 1e-6 * x;
    const double theory = 3 * (end * at - 0.5 * at * at) / (end * end * end);
    EXPECT_NEAR(slope / theory, 1, x == 100 ? 0.012 : 0.003) << x;
    EXPECT_GT(slope, before) << x;
    before = slope;
  }
}

TEST(AfmLever, AMirroredTipGivesTheMirroredAnswer) {
  const Calibration left = calibration_of(beam_with_tip, {"tip.offset=-8 um"});
  const Calibration right = calibration_of(beam_with_tip, {"tip.offset=8 um"});
  EXPECT_NEAR(left.normal_stiffness / right.normal_stiffness, 1, 1e-5);
  EXPECT_NEAR(left.normal.end.y() / right.normal.end.y(), -1, 1e-3);
  EXPECT_GT(std::abs(right.normal.end.y()), 1e-3 * right.normal.end.z());  // it twists
}

// Vertical stiffness at a tilt a: the displacement along z of a force along z. The lever gives way along
// its own z by 1/k, along its own x by next to nothing: k_n / cos^2 a, less what the tip's arm adds.
TEST(AfmLever, ATiltedTiplessLeverIsStifferByTheSquareOfTheCosine) {
  const std::string text = tipless_beam();
  const double flat = calibration_of(text).normal_stiffness;
  const double tilted = calibration_of(text, {"lever.tilt=11 deg"}).normal_stiffness;
  const double cosine = std::cos(11 * std::numbers::pi / 180);
  EXPECT_NEAR(tilted * cosine * cosine / flat, 1, 0.005);
}

// A coating of the lever's own material is the same as a thicker lever.
TEST(AfmLever, ACoatingOfTheSameMaterialIsAThickerLever) {
  const std::string text = tipless_beam();
  const double coated = calibration_of(text, {"lever.thickness=2 um", "lever.coating=lever",
                                              "lever.coating_thickness=0.2 um"})
                            .normal_stiffness;
  EXPECT_NEAR(coated / calibration_of(text).normal_stiffness, 1, 3e-3);
}

TEST(AfmLever, TheVAgreesWithNeumeisterAndDucker) {
  const Scene scene = shipped_afm("calibration-v.toml");
  const Calibration c = AfmSimulation(scene).calibrate();
  EXPECT_NEAR(c.closed_forms[0].value, 0.2968, 1e-4);
  EXPECT_NEAR(c.normal_stiffness / c.closed_forms[0].value, 1, 0.01);
  EXPECT_NEAR(c.bending_share, 0.025, 0.006);
}

// 200 to 4,400 times longer than thick. (Thicker ones are no plates any more: 3EI/L^3 is not the law.)
TEST(AfmLever, NothingLocksAndNoDigitsAreLostAtExtremeThickness) {
  const std::string text = tipless_beam();
  for (const double t : {0.1, 0.44, 2.2}) {
    const double thick = t * 1e-6, w = 50e-6, l = 440e-6;
    const Calibration c = calibration_of(text, {"lever.thickness=" + std::to_string(t) + " um"});
    EXPECT_NEAR(c.normal_stiffness / (200e9 * w * thick * thick * thick / (4 * l * l * l)), 1.012,
                0.003)
        << t;
    EXPECT_LT(c.imbalance, 1e-6) << t;
  }
}

TEST(AfmLever, AThickLeverOnACoarseMeshIsThatOnAFineOne) {
  const std::string text = tipless_beam();
  const double coarse = calibration_of(text, {"lever.thickness=10 um"}).normal_stiffness;
  const double fine =
      calibration_of(text, {"lever.thickness=10 um", "lever.aspect=0.5", "lever.layers=3"})
          .normal_stiffness;
  EXPECT_NEAR(coarse / fine, 1, 0.01);
}

// Two bonded layers: E I about the axis where their forces balance.
TEST(AfmLever, ACoatedLeverIsATwoLayerBeam) {
  const double e1 = 200e9, e2 = 80e9, t1 = 2e-6, t2 = 0.4e-6, w = 50e-6, l = 440e-6;
  const double axis = 0.5 * e2 * t2 * (t1 + t2) / (e1 * t1 + e2 * t2);  // above the lever's middle
  const double ei = w * (e1 * (t1 * t1 * t1 / 12 + t1 * axis * axis) +
                         e2 * (t2 * t2 * t2 / 12 + t2 * std::pow(0.5 * (t1 + t2) - axis, 2)));
  const std::string gold =
      "[[material]]\nname = \"gold\"\nyoungs_modulus = \"80 GPa\"\npoissons_ratio = 0\n";
  std::string text = tipless_beam();
  text.insert(text.find("[[material]]"), gold);
  const Calibration c =
      calibration_of(text, {"material.lever.poissons_ratio=0", "lever.thickness=2 um",
                            "lever.coating=gold", "lever.coating_thickness=0.4 um"});
  EXPECT_NEAR(c.normal_stiffness / (3 * ei / (l * l * l)), 1, 0.002);
}

// Tilted, coated, the tip beside the axis: beam theory still knows it.
TEST(AfmLever, TheClosedFormOfABeamKnowsTiltCoatingAndOffset) {
  const std::string gold =
      "[[material]]\nname = \"gold\"\nyoungs_modulus = \"80 GPa\"\npoissons_ratio = 0\n";
  std::string text = beam_with_tip;
  text.insert(text.find("[[material]]"), gold);
  for (const char* tilt : {"lever.tilt=0 deg", "lever.tilt=12 deg", "lever.tilt=-12 deg"}) {
    const Calibration c = calibration_of(
        text, {"material.lever.poissons_ratio=0", "lever.coating=gold", "tip.offset=10 um",
               "lever.coating_thickness=0.3 um", "tip.height=40 um", tilt});
    EXPECT_NEAR(c.normal_stiffness / c.closed_forms[0].value, 1, 0.005) << tilt;
    EXPECT_EQ(c.closed_forms[0].name, "beam, tilt and offset, composite");
  }
}

TEST(AfmLever, TheFormulasOfAVSayWhereTheyDoNotApply) {
  const Scene scene = shipped_afm("calibration-v.toml", {"lever.tilt=11 deg"});
  for (const ClosedForm& form : AfmSimulation(scene).calibrate().closed_forms)
    EXPECT_EQ(form.not_for, form.quantity == "k_n" ? "the lever is tilted" : "") << form.name;
}

// Euler's elastica: a dead force on the end of a cantilever, P L^2/(E I) = 1, 2, 5, 10.
TEST(AfmLever, ALargeDeflectionIsOnTheElastica) {
  const Scene scene = afm_scene(R"(family = "afm"
[[material]]
name = "m"
youngs_modulus = "200 GPa"
poissons_ratio = 0.0
[lever]
shape = "beam"
material = "m"
length = "100 um"
width = "2 um"
thickness = "0.4 um"
aspect = 5
)");
  AfmSimulation simulation(scene);
  const double ei = 200e9 * 2e-6 * 0.064e-18 / 12, l = 100e-6;
  struct {
    double load, w, shortening;
  } const elastica[] = {{1, 0.301721, 0.056433},
                        {2, 0.493457, 0.160642},
                        {5, 0.713792, 0.387628},
                        {10, 0.810609, 0.554996}};
  double before = 0;
  for (const auto& point : elastica) {
    NewtonReport report;
    for (int i = 1; i <= 8; ++i) {
      const double load = before + (point.load - before) * i / 8;
      report = simulation.load_tip({0, 0, load * ei / (l * l)});
      ASSERT_TRUE(report.converged) << point.load;
    }
    before = point.load;
    // The gauge is on the lower face, half the thickness from the line of the elastica.
    const double* u = simulation.world().column<Displacement>().values();
    const Vec3 end = read(simulation.model().foot, u);
    EXPECT_NEAR(end.z() / l / point.w, 1, 0.005) << point.load;
    EXPECT_NEAR(-end.x() / l / point.shortening, 1, 0.005) << point.load;
  }
}

}  // namespace
}  // namespace pulvis
