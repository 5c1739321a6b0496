// AFM scenes that are wrong are refused, with the place and with what is allowed.
#include <filesystem>
#include <fstream>

#include "tests/helpers/lever.hpp"
#include "tests/helpers/wrong.hpp"

namespace pulvis {
namespace {

std::string refusal(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return message_of([&] { load_scene_text(text, "wrong.toml", overrides); });
}

void expect_refusal(const std::vector<std::string>& overrides, const char* what) {
  EXPECT_NE(refusal(beam_with_tip, overrides).find(what), std::string::npos)
      << refusal(beam_with_tip, overrides);
}

TEST(WrongAfm, TheTestsOwnLeverIsRight) { EXPECT_EQ(refusal(beam_with_tip), ""); }

TEST(WrongAfm, TablesAndKeysOfOtherFamiliesAreRefused) {
  EXPECT_NE(refusal(std::string(beam_with_tip) + "[contact]\nfriction = 0.1\n")
                .find("has no meaning with family = \"afm\""),
            std::string::npos);
  expect_refusal({"thickness=1 mm"}, "has no effect with family = \"afm\"");
  expect_refusal({"material.lever.density=1 kg/m^3"}, "has no effect with family = \"afm\"");
  expect_refusal({"dimension=3"}, "dimension: belongs to scenes of particles");
  const std::string accuracy = refusal(beam_with_tip, {"accuracy=fine"});
  EXPECT_NE(accuracy.find("has no effect with family = \"afm\""), std::string::npos) << accuracy;
  EXPECT_EQ(accuracy.find("the mesh of every particle"), std::string::npos) << accuracy;
}

TEST(WrongAfm, ATipBesideTheLeverIsRefused) {
  expect_refusal({"tip.offset=24.5 um"}, "tip.offset");
  expect_refusal({"tip.set_back=0.5 um"}, "is not on the lever");
  expect_refusal({"tip.set_back=441 um"}, "is not on the lever");
}

TEST(WrongAfm, AFootWiderThanTheLeverIsRefusedWithTheBound) {
  expect_refusal({"tip.foot=60 um", "tip.set_back=31 um"}, "allowed: < 5e-05 m");
}

std::string beam_with_ball(const std::string& radius, const std::string& neck_radius) {
  return tipless_beam() + R"([tip]
shape = "sphere"
material = "stiff"
neck_height = "1 um"
set_back = "50 um"
radius = ")" +
         radius + "\"\nneck_radius = \"" + neck_radius + "\"\n";
}

TEST(WrongAfm, AGlueNeckWiderThanTheLeverOrTheBallIsRefused) {
  const std::string ball = beam_with_ball("40 um", "30 um");
  EXPECT_NE(refusal(ball).find("tip.neck_radius"), std::string::npos) << refusal(ball);
  EXPECT_NE(refusal(ball).find("allowed: < 2.5e-05 m"), std::string::npos) << refusal(ball);
  EXPECT_NE(refusal(ball, {"tip.radius=20 um"}).find("allowed: < 2e-05 m"), std::string::npos);
}

TEST(WrongAfm, AContactMeshThatIsTooFineOrTooLargeIsRefusedWithTheBound) {
  const std::string ball = beam_with_ball("10 um", "5 um");
  const auto refused = [&](const std::vector<std::string>& overrides, const char* what) {
    const std::string text = refusal(ball, overrides);
    EXPECT_NE(text.find(what), std::string::npos) << text;
  };
  refused({}, "");
  refused({"tip.contact_edge=0.1 um", "tip.contact_reach=2 um"}, "");
  refused({"tip.contact_edge=9 nm"},
          "tip.contact_edge: 9e-09 m is too small for this ball, "
          "allowed: 1e-08 to 2.5e-06 m");
  refused({"tip.contact_edge=20 um"}, "too large for this ball, allowed: ");
  refused({"tip.contact_edge=0.1 um", "tip.contact_reach=3 um"}, "allowed: <= 2.4e-06 m");
  refused({"tip.contact_reach=3 um"}, "contact_edge");
  EXPECT_NE(refusal(beam_with_tip, {"tip.contact_edge=0.1 um"}).find("tip.contact_edge"),
            std::string::npos);
}

TEST(WrongAfm, ALaserBesideTheLeverIsRefused) {
  expect_refusal({"laser.position=450 um"}, "laser.position");
  expect_refusal({"laser.offset=20 um", "laser.radius=10 um"}, "laser.position");
}

TEST(WrongAfm, ActionsNeedASurfaceAndAForceToKeep) {
  const std::string scan =
      std::string(beam_with_tip) +
      "[[action]]\nkind = \"scan\"\ndistance = \"1 um\"\nset_point = \"force\"\n";
  EXPECT_NE(refusal(scan).find("there is no surface"), std::string::npos);
  EXPECT_NE(refusal(scan + "[surface]\nshape = \"plane\"\n").find("no force to hold"),
            std::string::npos);
  for (const char* force : {"0 N", "-5 nN"}) {
    const std::string press =
        refusal(std::string(beam_with_tip) + "[[action]]\nkind = \"press\"\nforce = \"" + force +
                "\"\n[surface]\nshape = \"plane\"\n");
    EXPECT_NE(press.find("allowed: a quantity in N, > 0 and <= 1"), std::string::npos) << press;
  }
}

// The map of raster.toml reaches 710 nm from its middle to both sides.
TEST(WrongAfm, AScanThatLeavesTheHeightMapIsRefusedWithTheBound) {
  const auto refused = [](const std::vector<std::string>& overrides) {
    return message_of([&] { shipped_afm("raster.toml", overrides); });
  };
  EXPECT_EQ(refused({}), "");
  for (const char* key :
       {"action[3].distance=1400 nm", "action[3].width=1400 nm", "action[1].distance=-720 nm"}) {
    EXPECT_NE(refused({key}).find("the scan leaves the map"), std::string::npos) << refused({key});
    EXPECT_NE(refused({key}).find("allowed: -7.1e-07 to 7.1e-07 m"), std::string::npos)
        << refused({key});
  }
  EXPECT_NE(refused({"surface.file=nothing.csv"}).find("there is no such file"), std::string::npos);
}

TEST(WrongAfm, AnActionThatMovesNothingIsRefused) {
  const auto refused = [](const std::string& override) {
    return message_of([&] { shipped_afm("raster.toml", {override}); });
  };
  for (const std::string scan : {"action[1]", "action[3]"})
    EXPECT_NE(refused(scan + ".distance=0 m")
                  .find(scan + ".distance: 0 m: nothing moves, allowed: any other distance"),
              std::string::npos)
        << refused(scan + ".distance=0 m");
}

std::string refused_heights(const std::string& heights) {
  const auto file = std::filesystem::temp_directory_path() / "pulvis_wrong_heights.csv";
  std::ofstream(file) << heights;
  return message_of([&] {
    shipped_afm("raster.toml",
                {"surface.file=" + file.string(), "action[3].distance=10 nm",
                 "action[3].width=10 nm", "action[1].distance=-5 nm", "action[2].distance=-5 nm"});
  });
}

// Heights of any offset, but no cliffs: 100 times the spacing of 20 nm, as a bump's flanks.
TEST(WrongAfm, HeightsThatAreNoSurfaceAreRefusedWithTheBound) {
  EXPECT_EQ(refused_heights("0,1e-6,0\n0,0,0\n0,0,0\n"), "");
  EXPECT_EQ(refused_heights("0.1,0.1,0.1\n0.1,0.1,0.1\n0.1,0.1,0.1\n"), "");
  EXPECT_EQ(refused_heights("1e300,1e300,1e300\n1e300,1e300,1e300\n1e300,1e300,1e300\n"), "");
  for (const char* height : {"1e300", "-1e308", "1", "2.1e-6"}) {
    const std::string what = refused_heights(std::string("0,0,0\n0,") + height + ",0\n0,0,0\n");
    EXPECT_NE(what.find("two neighbouring heights differ by"), std::string::npos) << what;
    EXPECT_NE(what.find("allowed: up to 100 times the spacing, 2e-06 m"), std::string::npos)
        << what;
  }
  EXPECT_NE(refused_heights("1e308,-1e308\n0,0\n").find("differ by inf m"), std::string::npos);
  for (const char* height : {"nan", "inf", "1e999"}) {
    const std::string what = refused_heights(std::string("0,0,0\n0,") + height + ",0\n0,0,0\n");
    EXPECT_NE(what.find("line 2: no number"), std::string::npos) << what;
  }
}

TEST(WrongAfm, AWaveOfMoreFacetsThanMemoryHoldsIsRefused) {
  const std::string what =
      refusal(std::string(beam_with_tip) +
              "[surface]\nshape = \"sinusoid\"\nheight = \"1 pm\"\nwavelength = \"1 pm\"\n"
              "[[action]]\nkind = \"press\"\ndistance = \"10 nm\"\n");
  EXPECT_NE(what.find("surface.wavelength: 1e-12 m"), std::string::npos) << what;
  EXPECT_NE(what.find("allowed: 1000000 at most"), std::string::npos) << what;
}

TEST(WrongAfm, AVWhoseArmsDoNotMeetIsRefused) {
  const std::string v = R"(family = "afm"
[[material]]
name = "m"
youngs_modulus = "200 GPa"
poissons_ratio = 0.3
[lever]
shape = "v"
material = "m"
length = "100 um"
thickness = "1 um"
half_angle = "30 deg"
arm_width = "20 um"
[tip]
set_back = "5 um"
)";
  EXPECT_EQ(refusal(v), "");
  EXPECT_NE(refusal(v, {"lever.arm_width=51 um"}).find("allowed: < 5e-05 m"), std::string::npos);
  EXPECT_NE(refusal(v, {"lever.base_width=100 um"}).find("one of them"), std::string::npos);
  // Between the arms: tan(30 deg) times 50 um and 90 um from the axis 10 um from the clamp.
  const std::string open = refusal(v, {"laser.position=10 um"});
  EXPECT_NE(open.find("before x = 6e-05 m the V is open, and its arms are 2.88675e-05 to "
                      "5.19615e-05 m from its axis there"),
            std::string::npos)
      << open;
}

TEST(WrongAfm, AKeyOfTheMeshThatChangesNothingIsRefused) {
  expect_refusal({"lever.aspect=12"}, "lever.aspect: 12 is out of range");
  expect_refusal({"lever.aspect=0.6"}, "allowed: 1.33 to 10");
  expect_refusal({"lever.elements_across=4", "lever.side_aspect=1"},
                 "lever.side_aspect: has no effect");
  expect_refusal({"lever.elements_along=40", "lever.foot_layers=2"},
                 "lever.foot_layers: has no effect");
  expect_refusal({"lever.elements_along=40", "lever.elements_across=4", "lever.aspect=6"},
                 "lever.aspect: has no effect");
}

}  // namespace
}  // namespace pulvis
