// What `check` says of scenes whose values are all allowed, and yet not what anybody wants.
#include "scenes/setup_warnings.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "scenes/build.hpp"
#include "scenes/checks/lever_warnings.hpp"
#include "scenes/checks/travel.hpp"
#include "scenes/outlines/outline.hpp"
#include "scenes/packing/place.hpp"
#include "tests/helpers/afm_run.hpp"
#include "tests/helpers/experiment.hpp"
#include "tests/helpers/wrong.hpp"

namespace pulvis {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

Scene die_of_25(const std::vector<std::string>& overrides = {}) {
  return read_scene(paths::source_dir() + "/scenes/compaction/regular-25.toml", overrides);
}

std::vector<std::string> warnings_of_25(const std::vector<std::string>& overrides = {}) {
  const Scene scene = die_of_25(overrides);
  return setup_warnings(scene, place_bodies(scene));
}

std::string refusal_of_25(const std::vector<std::string>& overrides) {
  return message_of([&] { build_world(die_of_25(overrides)); });
}

TEST(SetupWarnings, AnOrdinaryDieHasNone) { EXPECT_THAT(warnings_of_25(), IsEmpty()); }

// 5 mm in 2.8 ms are 2 m/s between its ramps: 0.016 MPa of 240. At a hundredth of the time it is ten thousand times that.
TEST(SetupWarnings, APunchIsTooFastWhereItsPowdersKineticEnergyCounts) {
  EXPECT_THAT(warnings_of_25({"stage[0].duration=0.028 ms"}),
              ElementsAre(HasSubstr("tool 'top' moves at up to 198 m/s")));
  EXPECT_THAT(warnings_of_25({"stage[0].duration=0.5 ms"}), IsEmpty());
  // A punch that leaves the powder presses nothing.
  EXPECT_THAT(warnings_of_25({"stage[0].duration=0.028 ms",
                              "stage[0].move[0].displacement=[\"0 mm\", \"5 mm\"]"}),
              ElementsAre(HasSubstr("tool 'top' moves away from the powder")));
}

// 25 discs in 50 mm x 50 mm are full at a height of 25 pi/4 100/50 mm = 39.27 mm: after 10.73 mm.
TEST(SetupWarnings, ATravelBeyondFullDensityIsRefusedWithTheOneThatReachesIt) {
  const auto to = [](const char* travel) {
    return std::vector{std::string("stage[0].move[0].displacement=[\"0 mm\", \"-") + travel +
                       "\"]"};
  };
  EXPECT_EQ(refusal_of_25(to("10.7 mm")), "");
  EXPECT_THAT(warnings_of_25(to("10.7 mm")), IsEmpty());
  const Scene beyond = die_of_25(to("12 mm"));
  const auto full = full_density(beyond, place_bodies(beyond));
  ASSERT_TRUE(full.has_value());
  const double area = 25 * outline_area(beyond.particles[0].outline);
  EXPECT_NEAR(full->until_full, 0.05 - area / 0.05, 1e-12);
  EXPECT_NEAR(full->density, area / (0.05 * 0.038), 1e-12);
  EXPECT_THAT(warnings_of_25(to("12 mm")), ElementsAre(HasSubstr("beyond full density")));
  const std::string refused = refusal_of_25(to("30 mm"));
  EXPECT_THAT(refused, HasSubstr("stage[0].move[0].displacement"));
  EXPECT_THAT(refused, HasSubstr("allowed: a travel of up to about 0.0107"));
}

TEST(SetupWarnings, AStageOfCompactionThatLoadsNothingIsTold) {
  const auto lines_in_space = [](const std::vector<std::string>& overrides) {
    const Scene scene =
        read_scene(paths::source_dir() + "/scenes/compaction-3d/one-sphere.toml", overrides);
    std::string all;
    for (const std::string& line : setup_warnings(scene, place_bodies(scene))) all += line + "\n";
    return all;
  };
  const char* away = "tool 'top' moves away from the powder, and no tool moves towards it";
  EXPECT_THAT(warnings_of_25({"stage[0].move[0].displacement=[\"0 mm\", \"5 mm\"]"}),
              ElementsAre(HasSubstr(away)));
  EXPECT_THAT(warnings_of_25(
                  {"stage[0].kind=unload", "stage[0].move[0].displacement=[\"0 mm\", \"5 mm\"]"}),
              IsEmpty());
  EXPECT_THAT(lines_in_space({"stage[0].move.top.displacement=[\"0 mm\", \"0 mm\", \"0.1 mm\"]"}),
              HasSubstr(away));
  EXPECT_THAT(lines_in_space({}), ::testing::Not(HasSubstr(away)));
}

// Without a die around the powder no density tells how far is too far: the plates themselves do.
TEST(SetupWarnings, PlatesThatMeetAreRefused) {
  const auto refusal = [](const std::string& scene, const std::vector<std::string>& overrides) {
    return message_of([&] { build_world(read_scene(paths::source_dir() + scene, overrides)); });
  };
  EXPECT_THAT(refusal("/scenes/basic/disc-platens.toml",
                      {"stage.press.move.top.displacement=[\"0 mm\", \"-100 mm\"]"}),
              HasSubstr("stage[0].move[1].displacement: stage 'press': tools 'top' and 'bottom' "
                        "approach each other by 0.1 m, but are 0.01 m apart at its start"));
  EXPECT_THAT(refusal("/scenes/compaction-3d/one-sphere.toml",
                      {"stage.press.move.top.displacement=[\"0 mm\", \"0 mm\", \"-100 mm\"]"}),
              HasSubstr("tools 'top' and 'bottom' approach each other by 0.1 m"));
  // Both move.
  EXPECT_THAT(refusal("/scenes/basic/disc-platens.toml",
                      {"stage.press.move.top.displacement=[\"0 mm\", \"-5 mm\"]",
                       "stage.press.move.bottom.displacement=[\"0 mm\", \"5.001 mm\"]"}),
              HasSubstr("tools 'bottom' and 'top' approach each other by 0.01 m"));
  EXPECT_EQ(refusal("/scenes/basic/disc-platens.toml", {}), "");
  EXPECT_EQ(refusal("/scenes/compaction-3d/one-sphere.toml", {}), "");
}

// Where positions are rounded to more than a billionth of a particle, contact gaps are: the limit is a distance of 4.5
// million diameters of a sphere.
TEST(SetupWarnings, ParticlesTooFarFromTheOriginForTheirSizeAreRefused) {
  const auto refusal_of_ball = [](double distance) {
    const std::string at = fmt::format("[\"{} m\", \"0 mm\", \"5 nm\"]", distance);
    return message_of([&] {
      build_world(read_scene(paths::source_dir() + "/scenes/compaction-3d/one-sphere.toml",
                             {"particle.ball.diameter=10 nm", "body[0].position=" + at,
                              "tool.top.point=[\"0 m\", \"0 m\", \"10 nm\"]",
                              "stage.press.move.top.displacement=[\"0 m\", \"0 m\", \"-2 nm\"]",
                              "stage.release.move.top.displacement=[\"0 m\", \"0 m\", \"1 nm\"]"}));
    });
  };
  EXPECT_THAT(refusal_of_ball(1),
              HasSubstr("body[0].position: 'ball', 1e-08 m in size, is placed 1 m from the origin, "
                        "where positions are rounded to 2.2e-16 m: contact gaps would be wrong by "
                        "2.2e-08 of its size, allowed: up to 1e-09 of it, i.e. within 0.045 m"));
  EXPECT_EQ(refusal_of_ball(0.04), "");
  EXPECT_THAT(refusal_of_25({"particle[0].diameter=1 nm", "packing[0].spacing=1.01 nm",
                             "packing[0].corner=[\"-1 m\", \"0 m\"]"}),
              HasSubstr("packing[0]: 'disc', 8.86e-10 m in size, is placed 1 m from the origin"));
}

// 25 discs touch at a relative density of pi/4, four spheres in a cell at pi/6.
TEST(SetupWarnings, AStageThatIsOverBeforeItBeginsIsTold) {
  const auto until = [](double density) {
    return std::vector{fmt::format("stage[0].until.relative_density={}", density)};
  };
  EXPECT_THAT(warnings_of_25(until(0.7)),
              ElementsAre(HasSubstr("is 0.785 at the start, and it ends at 0.7 (stage.until)")));
  EXPECT_THAT(warnings_of_25(until(0.8)), IsEmpty());
  const std::string cell = paths::source_dir() + "/scenes/compaction-3d/unit-cell-sc.toml";
  for (const auto& [density, told] : {std::pair(0.5, true), {0.6, false}}) {
    const Scene scene = read_scene(cell, until(density));
    const auto lines = setup_warnings(scene, place_bodies(scene));
    EXPECT_EQ(std::ranges::any_of(lines,
                                  [](const std::string& line) {
                                    return line.find("ends as soon as it begins") !=
                                           std::string::npos;
                                  }),
              told);
  }
}

TEST(SetupWarnings, AToolThatFacesAwayIsNamedOnceWithTheNormalThatWouldDo) {
  const auto problems = problems_in([] { build_world(die_of_25({"tool.top.normal=[0, 1]"})); });
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_THAT(problems[0].message, HasSubstr("tool 'top' faces away from the powder"));
  EXPECT_THAT(problems[0].message, HasSubstr("[0, -1]"));
  EXPECT_EQ(problems[0].key, "tool[3].normal");
}

TEST(SetupWarnings, WallsBesideTheRoomOfThePackingAreTold) {
  EXPECT_THAT(warnings_of_25({"tool.right.point=[\"52 mm\", \"0 mm\"]"}),
              ElementsAre(HasSubstr(
                  "packing[0] is generated for a die 0.05 m wide (x = 0 to 0.05 m), but")));
}

// Springback, ejection, a state for others: in both dimensions, of soft contacts only, and not of scenes that only load.
TEST(SetupWarnings, SoftContactsAreToldWhereTheElasticResponseCounts) {
  const auto of = [](const std::string& file, const std::vector<std::string>& overrides = {}) {
    const Scene scene = read_scene(paths::source_dir() + "/scenes/" + file, overrides);
    std::vector<std::string> lines = setup_warnings(scene, place_bodies(scene));
    std::erase_if(lines, [](const std::string& line) {
      return line.find("elastic response") == std::string::npos;
    });
    return lines;
  };
  const std::vector<std::string> soft{"contact.stiffness=0.5"}, stiff{"contact.stiffness=10"};
  for (const char* file : {"compaction/ejection-25.toml", "compaction-3d/tablet.toml"}) {
    EXPECT_THAT(
        of(file, soft),
        ElementsAre(AllOf(HasSubstr("stage 'unload' unloads the powder"),
                          HasSubstr("use contact.stiffness = 10 (up to a quarter more CPU time)"))))
        << file;
    EXPECT_THAT(of(file, stiff), IsEmpty()) << file;
  }
  for (const char* file : {"compaction/regular-25.toml", "compaction-3d/unit-cell-sc.toml",
                           "bonds/pulled-blocks.toml"})
    EXPECT_THAT(of(file, soft), IsEmpty()) << file;
  EXPECT_THAT(of("periodic/square.toml", {"stage[0].keep_state=true", soft[0]}),
              ElementsAre(HasSubstr("keeps its state for other runs")));
}

// 12 to the power 1/(rings - 1).
TEST(SetupWarnings, RingsThatAreGradedTooSteeplyAreTold) {
  const auto of = [](const char* rings) {
    const Scene scene = read_scene(
        paths::source_dir() + "/scenes/basic/disc-platens.toml",
        {"particle.disc.mesh.refinement=12", std::string("particle.disc.mesh.rings=") + rings});
    return setup_warnings(scene, place_bodies(scene));
  };
  EXPECT_THAT(of("2"), ElementsAre(HasSubstr("each ring is 12 times as thick as the next")));
  EXPECT_THAT(of("2"), ElementsAre(HasSubstr("rings >= 4")));
  EXPECT_THAT(of("3"), ElementsAre(HasSubstr("3.46 times")));
  EXPECT_THAT(of("4"), IsEmpty());
}

TEST(LeverWarnings, AreOfDimensionsThatNoLeverHas) {
  const auto of = [](std::vector<std::string> overrides) {
    return lever_warnings(afm_scene(beam_with_tip, overrides));
  };
  EXPECT_THAT(of({}), IsEmpty());
  EXPECT_THAT(of({"lever.thickness=60 um"}),
              ElementsAre(HasSubstr("lever.length = 0.00044 m is 7.33 times lever.thickness"),
                          HasSubstr("bends sideways more easily")));
  EXPECT_THAT(of({"lever.width=400 um"}), ElementsAre(HasSubstr("bends like a plate")));
}

// E w t^3/(4 L^3) = 200 GPa 50 um (2.2/440)^3/4.
TEST(LeverWarnings, TheRoughStiffnessIsThatOfABeam) {
  EXPECT_NEAR(*rough_stiffness(afm_scene(beam_with_tip)), 0.3125, 1e-12);
}

// ---- all of them -------------------------------------------------------------------------------------
// Two cylinders, end to end, whose glue softens over 0.35 mm, less than three of their faces; pressed for 1 us.
Scene glued_cylinders() {
  std::string text = R"(
family = "compaction"
dimension = 3
[[material]]
name = "stone"
density = "2000 kg/m^3"
youngs_modulus = "20 GPa"
poissons_ratio = 0.0
[[particle]]
name = "p"
material = "stone"
shape = "cylinder"
diameter = "1 mm"
height = "1 mm"
rounding = "0.05 mm"
mesh = { divisions = 4, rings = 2, axial_divisions = 6, grid = "extruded" }
[[bond]]
between = ["stone", "stone"]
origin = "initial"
strength = "10 MPa"
fracture_energy = "2 J/m^2"
reach = 0.3
[[body]]
particle = "p"
position = ["0 mm", "0 mm", "0.5 mm"]
[[body]]
particle = "p"
position = ["0 mm", "0 mm", "1.512 mm"]
[[tool]]
name = "bottom"
shape = "plane"
point = ["0 mm", "0 mm", "-0.012 mm"]
normal = [0, 0, 1]
[[tool]]
name = "top"
shape = "plane"
point = ["0 mm", "0 mm", "2.1 mm"]
normal = [0, 0, -1]
[[stage]]
name = "press"
kind = "compact"
duration = "1 us"
[[stage.servo]]
tool = "top"
force = "1 N"
)";
  return own_scene(text);
}

TEST(AllWarnings, AreOfBondsAndServosTooInThreeDimensions) {
  const Scene scene = glued_cylinders();
  Simulation simulation(scene);
  const auto lines = all_warnings(scene, place_bodies(scene), &simulation.world());
  EXPECT_THAT(lines, Contains(HasSubstr("cohesive zone ahead of a crack")));
  EXPECT_THAT(lines, Contains(HasSubstr("tool 'top' may not reach 1 N")));
  for (const std::string& line : all_warnings(scene, place_bodies(scene), nullptr))
    EXPECT_THAT(line, Not(HasSubstr("cohesive zone")));
}

}  // namespace
}  // namespace pulvis
