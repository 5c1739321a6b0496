// Tools that hold a force, target surfaces.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "components/servo.hpp"
#include "engine/run_failure.hpp"
#include "scenes/tools/profile.hpp"
#include "tests/helpers/experiment.hpp"
#include "tests/helpers/paths.hpp"
#include "tests/helpers/right_scene.hpp"

namespace pulvis {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::vector<std::string> joined(std::vector<std::string> first,
                                const std::vector<std::string>& more) {
  first.insert(first.end(), more.begin(), more.end());
  return first;
}

const std::vector<std::string> one_sheared{"packing[0].rows=1", "packing[0].columns=1",
                                           "tool.right.point=[\"10 mm\", \"0 mm\"]",
                                           "tool.top.point=[\"0 mm\", \"10 mm\"]"};

TEST(Servo, HoldsItsForceWhileTheTargetSlides) {
  Experiment e(
      "shear/flat-16.toml",
      joined(one_sheared, {"stage.load.servo.top.force=1 kN", "stage.load.duration=0.6 ms",
                           "stage.shear.servo.top.force=1 kN", "stage.shear.duration=0.4 ms",
                           "stage.shear.move.target.displacement=[\"0.4 mm\", \"0 mm\"]"}));
  double worst = 0, friction = 0;
  e.run(100, [&] {
    const bool drawn = e.value("shear/friction") > 0.02;  // a smaller force has no shares
    EXPECT_EQ(std::isnan(e.value("shear/wall_share")), !drawn);
    const double time = e.simulation.clock().time;
    if (time < 0.75e-3 || time > 0.9e-3) return;
    worst = std::max(worst, std::abs(e.value("tool/top/force_y") - 1000));
    friction = std::max(friction, std::abs(e.value("shear/friction") - 0.1));
  });
  EXPECT_LT(worst, 10);
  EXPECT_LT(friction, 1e-3);
  EXPECT_NEAR(e.value("shear/distance"), 0.4e-3, 1e-9);
}

// Under a held force the normal force over the distance is the product of both. Plastic flow of loading does not count.
TEST(Shear, PloughingIsThePlasticWorkOverWhatPresses) {
  Experiment e(
      "shear/grooves-16.toml",
      joined(one_sheared, {"stage.load.servo.top.force=1 kN", "stage.load.duration=0.6 ms",
                           "stage.shear.servo.top.force=1 kN", "stage.shear.duration=0.8 ms",
                           "stage.shear.move.target.displacement=[\"1 mm\", \"0 mm\"]"}));
  double before = 0;
  e.run(100, [&] {
    if (e.value("shear/distance") == 0) before = e.value("energy/plastic");
    const double ploughing = e.value("shear/ploughing");
    EXPECT_EQ(std::isnan(ploughing), e.value("shear/distance") < 0.02 * 1e-3);
    EXPECT_FALSE(ploughing > 1);
  });
  const double flow = e.value("energy/plastic") - before;
  EXPECT_GT(flow, 0.01 * 1000 * 1e-3);
  EXPECT_NEAR(e.value("shear/plastic_work") / flow, 1, 1e-2);
  EXPECT_NEAR(e.value("shear/ploughing") / (flow / (1000 * 1e-3)), 1, 5e-2);
}

TEST(Servo, StopsWithTheForceReachedWhereItCannotReachMore) {
  Experiment e("shear/flat-16.toml",
               joined(one_sheared, {"stage.load.servo.top.force=1 MN", "stage.load.duration=0.1 ms",
                                    "stage.load.servo.top.max_speed=0.5 m/s"}));
  EXPECT_THAT(message_of<RunFailure>([&] { e.run(10); }),
              AllOf(HasSubstr("tool_servo: 'top' carries "), HasSubstr("target 1e+06 N")));
}

// A body on an incline: (s + mu) / (1 - mu s) up, (mu - s) / (1 + mu s) down. The way of the disc over the
// grooves' flanks, mm: up from 0.4 to 1.5, down from 3.3 to 5.
TEST(Shear, ADiscOverGroovesFollowsTheLawOfTheInclineBothWays) {
  constexpr double mu = 0.3, s = 0.25;
  constexpr double up = (s + mu) / (1 - mu * s), down = (mu - s) / (1 + mu * s);
  Experiment e("shear/groove-law.toml", {"contact.friction=0.3"});
  int seen = 0;
  e.run(200, [&] {
    const double way = e.value("shear/distance");
    const bool rising = way > 0.4e-3 && way<1.5e-3, falling = way> 3.3e-3 && way < 5e-3;
    if (!rising && !falling) return;
    const double wanted = rising ? up : down;
    EXPECT_NEAR(e.value("shear/friction"), wanted, 0.005 * wanted) << way;
    ++seen;
  });
  EXPECT_GT(seen, 50);
}

const std::vector<std::string> one_in_its_die =
    joined(one_sheared, {"stage.load.servo.top.force=1 kN", "stage.load.duration=0.6 ms",
                         "stage.shear.servo.top.force=1 kN", "stage.shear.duration=0.4 ms",
                         "stage.shear.move.target.displacement=[\"0.4 mm\", \"0 mm\"]"});

Experiment sheared(const std::string& law, const std::vector<std::string>& more = {}) {
  const std::string text =
      "extends = \"shear/flat-16.toml\"\n[[friction]]\nbetween = [\"316L\", \"target\"]\n" + law;
  return Experiment(own_scene(text, joined(one_in_its_die, more)));
}

TEST(Shear, DynamicMeanIsThatOfTheLaw) {
  Experiment e =
      sheared("coefficient = 0.1\nstatic_coefficient = 0.2\ndecay_length = \"0.02 mm\"\n");
  e.run(400);
  const auto figures = e.results.shear().figures();
  ASSERT_TRUE(figures);
  EXPECT_NEAR(figures->dynamic_friction.value(), 0.1, 5e-4);
}

// What a later stage does to the target, that goes back behind its start, is no part of them; sums over the distance go on.
TEST(Shear, ATargetThatGoesBackDoesNotChangeWhatItsStageFound) {
  const std::string back =
      "[[stage]]\nname = \"back\"\nkind = \"shear\"\nduration = \"0.6 ms\"\n[[stage.move]]\ntool = "
      "\"target\"\n"
      "displacement = [\"-1 mm\", \"0 mm\"]\n";
  Experiment there = sheared("coefficient = 0.1\n");
  there.run(400);
  Experiment e = sheared("coefficient = 0.1\n" + back);
  std::vector<double> flow, ploughing;
  e.run(800, [&] {
    if (e.value("shear/distance") == 0) return;
    flow.push_back(e.value("shear/plastic_work"));
    ploughing.push_back(e.value("shear/ploughing"));
  });
  EXPECT_LT(e.value("shear/distance"), -1e-4);
  const auto figures = e.results.shear().figures(), before = there.results.shear().figures();
  ASSERT_TRUE(figures && before);
  EXPECT_NEAR(figures->distance, before->distance, 0.02 * before->distance);
  EXPECT_NEAR(figures->dynamic_friction.value(), 0.1, 1e-3);
  EXPECT_NEAR(figures->static_friction.value(), before->static_friction.value(), 1e-3);
  EXPECT_TRUE(std::ranges::is_sorted(flow));
  EXPECT_TRUE(std::ranges::is_partitioned(ploughing, [](double p) { return std::isnan(p); }));
  EXPECT_FALSE(std::isnan(ploughing.back()));
}

// The disc cannot roll between tools that hold it better than the target does, so that its contact slides as a whole.
Experiment sliding(const std::string& decay_length) {
  return sheared(
      "coefficient = 0.1\nstatic_coefficient = 0.2\ndecay_length = \"" + decay_length + "\"\n",
      {"contact.friction=0.5"});
}

// A decay over metres leaves it alone.
TEST(Shear, StaticFrictionIsThatOfTheLaw) {
  Experiment e = sliding("1 m");
  e.run(400);
  const auto figures = e.results.shear().figures();
  ASSERT_TRUE(figures);
  EXPECT_NEAR(figures->static_friction.value(), 0.2, 1e-4);
}

// Points of an edge come and go one by one as a disc is pressed and slid.
TEST(Shear, APointThatIsApartHasItsStaticFrictionAgain) {
  Experiment e = sliding("0.02 mm");
  int faded = 0, apart = 0;
  e.run(200, [&] {
    const auto& lost = e.column<SlipWeakening<ToolContact>>();
    const double* force = e.column<PointForce<ToolContact>>().values();
    const auto* touches = e.column<ContactTouches<ToolContact>>().values();
    for (std::size_t i = 0; i < edge_points * lost.table.rows; ++i) {
      const bool bears = std::hypot(force[2 * i], force[2 * i + 1]) > 0;
      if (bears) faded += lost.values()[i] > 0.5 ? 1 : 0;
      if (bears) continue;
      apart += touches[i / edge_points] != 0 ? 1 : 0;
      EXPECT_EQ(lost.values()[i], 0);
    }
  });
  EXPECT_GT(faded, 100);
  EXPECT_GT(apart, 100);
}

// As e^(-distance / decay length), from wherever one begins to look. As the force falls the disc springs back by some
// micrometres, which are slid, too.
TEST(Shear, StaticFrictionFadesAsTheLawSays) {
  Experiment e = sliding("0.1 mm");
  std::vector<double> distance, left;
  e.run(400, [&] {
    distance.push_back(e.value("shear/distance"));
    left.push_back(e.value("shear/friction") - 0.1);
  });
  constexpr double begin = 0.1e-3, decay = 0.1e-3;
  for (const double further : {0.05e-3, 0.1e-3, 0.15e-3, 0.2e-3})
    EXPECT_NEAR(decay * std::log(at(distance, left, begin) / at(distance, left, begin + further)),
                further, 6e-6);
}

double dynamic_friction_with_strength(const char* strength) {
  Experiment e = sheared(std::string("coefficient = 0.3\nshear_strength = \"") + strength + "\"\n",
                         {"contact.stiffness=0.5"});
  e.run(400);
  const auto figures = e.results.shear().figures();
  EXPECT_TRUE(figures);
  return figures ? figures->dynamic_friction.value_or(0) : 0;
}

// A strength k far below the friction 0.3 p of the contact's pressure is borne on the whole contact: the force is k
// times its area, which the same load keeps. So the coefficient is k / p, and p the pressure under a flat
// punch on plastic material in plane strain, (2 + pi) / sqrt(3) of the yield stress of 240 MPa, and more where
// it has hardened: its modulus of 440 MPa adds 44 MPa for a strain of 0.1.
TEST(Shear, ShearStrengthCapsTheForceByTheContactsArea) {
  const double one = dynamic_friction_with_strength("10 MPa"),
               two = dynamic_friction_with_strength("20 MPa"),
               four = dynamic_friction_with_strength("40 MPa");
  EXPECT_NEAR(two / one, 2, 0.01);  // the servo holds the load within 1%, its mean better
  EXPECT_NEAR(four / one, 4, 0.02);
  constexpr double punch = (2 + std::numbers::pi) / std::numbers::sqrt3;
  EXPECT_GT(20e6 / two, punch * 240e6);
  EXPECT_LT(20e6 / two, punch * (240e6 + 44e6));
}

TEST(Servo, IsNotThereWhereNoStageAsks) {
  Experiment e("compaction/regular-25.toml");
  EXPECT_FALSE(e.simulation.world().has<ServoTravel>());
  EXPECT_FALSE(e.simulation.world().has<ToolServos>());
  EXPECT_FALSE(e.simulation.world().has<StageEnds>());
}

// ---- target surfaces --------------------------------------------------------------------------------
// Mean distance from the mean line of a chain of points, by the trapezoidal rule on many stations.
double roughness(const ProfileSpec& relief) {
  std::vector<Vec2> points = one_pitch(relief);
  points.push_back(points.front() + Vec2(relief.pitch, 0));
  constexpr int stations = 20000;
  std::vector<double> heights;
  std::size_t piece = 0;
  for (int i = 0; i < stations; ++i) {
    const double x = points.front().x() + relief.pitch * (i + 0.5) / stations;
    while (points[piece + 1].x() < x) ++piece;
    const Vec2 a = points[piece], b = points[piece + 1];
    heights.push_back(a.y() + (b.y() - a.y()) * (x - a.x()) / (b.x() - a.x()));
  }
  double mean = 0, sum = 0;
  for (const double h : heights) mean += h / stations;
  for (const double h : heights) sum += std::abs(h - mean) / stations;
  return sum;
}

TEST(Profile, HasTheRoughnessThatIsAskedFor) {
  using Kind = ProfileSpec::Kind;
  for (const Kind kind : {Kind::triangle, Kind::trapezoid, Kind::sine}) {
    ProfileSpec relief;
    relief.kind = kind;
    relief.pitch = 8e-3;
    relief.ra = 0.3e-3;
    // A sine is drawn by 32 chords, which stay within it.
    EXPECT_NEAR(roughness(relief), 0.3e-3, kind == Kind::sine ? 2e-6 : 1e-9);
  }
}

TEST(Profile, ReachesAsFarAsThePowderComesOverIt) {
  const Scene scene = read_scene(paths::source_dir() + "/scenes/shear/grooves-16.toml");
  const std::vector<Vec2>& points = scene.tools.at(2).points;
  // The target goes 2 mm to the right: powder of 0 to 40 mm stands over -2 to 40 mm of it.
  EXPECT_LT(points.front().x(), -2e-3);
  EXPECT_GT(points.back().x(), 40e-3);
  for (const Vec2& p : points) EXPECT_LE(p.y(), 0);
}

// 16 discs stand on the crests of five grooves, which belong to the volume under the punch: a triangle of
// depth x pitch / 2 each, and what the rounding takes off the crest, r^2 (tan a - a) with flanks at the angle a.
TEST(Profile, GroovesBelongToTheVolumeOfRelativeDensity) {
  Experiment e("shear/grooves-16.toml", {"tool.target.depth=1.9 mm"});
  e.simulation.observe();
  e.results.sample();
  const double flank = std::atan(1.9 / 4), disc = std::acos(-1.0) * 25;
  const double groove = 0.5 * 8 * 1.9 + 0.4 * 0.4 * (std::tan(flank) - flank);
  EXPECT_NEAR(e.value("relative_density"), 16 * disc / (1600 + 5 * groove), 1e-6);
}

TEST(StageUntil, ADensityCountsTheGrooves) {
  Experiment e("shear/grooves-16.toml",
               joined(one_sheared, {"stage.load.servo.top.force=5 kN", "stage.load.duration=1 ms",
                                    "stage.load.servo.top.tolerance=1e9",
                                    "stage.load.until.relative_density=0.8"}));
  while (e.simulation.world().resource<ToolProgram>().stage_at(e.simulation.clock().time) == 0)
    e.simulation.run_steps(1);
  e.simulation.observe();
  e.results.sample();
  EXPECT_NEAR(e.value("relative_density"), 0.8, 0.003);
}

// ---- bad input ----------------------------------------------------------------------------------------
struct Wrong {
  const char* name;
  const char* text;  // after the right scene, whose last table is a stage
  const char* key;
  const char* says;
};
void PrintTo(const Wrong& wrong, std::ostream* stream) { *stream << wrong.name; }

class WrongDrive : public testing::TestWithParam<Wrong> {};

TEST_P(WrongDrive, IsRefused) {
  const auto problems = problems_of(std::string(right_scene) + GetParam().text);
  ASSERT_FALSE(problems.empty());
  EXPECT_THAT(problems.front().key, HasSubstr(GetParam().key)) << problems.front().text();
  EXPECT_THAT(problems.front().text(), HasSubstr(GetParam().says));
}

#define STAGE "[[stage]]\nname = \"more\"\nkind = \"hold\"\nduration = \"1 ms\"\n"
#define PROFILE "[[tool]]\nname = \"target\"\nshape = \"profile\"\npoint = [\"0 mm\", \"-9 mm\"]\n"

INSTANTIATE_TEST_SUITE_P(
    Drives, WrongDrive,
    testing::Values(
        Wrong{"UntilNothing", STAGE "[stage.until]\n", "until", "allowed: one"},
        Wrong{"UntilTwoThings",
              STAGE "[stage.until]\ntool = \"top\"\nforce = \"1 N\"\ndisplacement = \"1 mm\"\n",
              "until", "allowed: one"},
        Wrong{"ServoWithRiseAndRate",
              STAGE
              "[[stage.servo]]\ntool = \"top\"\nforce = \"1 N\"\nrise = 0.1\nrate = \"1 N/s\"\n",
              "servo[0].rise", "allowed: one of the two"},
        Wrong{"ServoTwice",
              STAGE "[[stage.servo]]\ntool = \"top\"\nforce = \"1 N\"\n[[stage.servo]]\ntool = "
                    "\"top\"\nforce = \"2 N\"\n",
              "servo[1].tool", "two servos"},
        Wrong{"ProfileWithoutPitch", PROFILE "relief = \"sine\"\nra = \"1 um\"\n", "pitch",
              "required key is missing"},
        Wrong{"ProfileWithDepthAndRa",
              PROFILE "relief = \"sine\"\npitch = \"1 mm\"\nra = \"1 um\"\ndepth = \"1 um\"\n",
              "ra", "one of the two"},
        Wrong{"FlatWithPitch", PROFILE "relief = \"flat\"\npitch = \"1 mm\"\n", "pitch",
              "only with relief = \"triangle\", \"sine\" or \"trapezoid\""},
        Wrong{
            "RoughWithPitch",
            PROFILE
            "relief = \"rough\"\npitch = \"1 mm\"\nra = \"1 um\"\ncorrelation_length = \"1 mm\"\n",
            "pitch", "only with relief"},
        Wrong{"RoughWithoutRa", PROFILE "relief = \"rough\"\ncorrelation_length = \"1 mm\"\n", "ra",
              "required key is missing"},
        Wrong{"RoughWithoutLength", PROFILE "relief = \"rough\"\nra = \"1 um\"\n",
              "correlation_length", "required key is missing"},
        Wrong{"RoughTooFine",
              PROFILE "relief = \"rough\"\nra = \"1 nm\"\ncorrelation_length = \"1 um\"\n",
              "correlation_length", "allowed: >= "},
        Wrong{"MeasuredWithoutFile", PROFILE "relief = \"file\"\n", "file",
              "required key is missing"},
        Wrong{"FileOfASine",
              PROFILE "relief = \"sine\"\npitch = \"1 mm\"\nra = \"1 um\"\nfile = \"a.csv\"\n",
              "file", "only with relief = \"file\""},
        Wrong{
            "ServoOfAConstraint",
            "[[tool]]\nname = \"hand\"\nshape = \"constraint\"\nlow = [\"0 mm\", \"0 mm\"]\nhigh = "
            "[\"1 mm\", \"1 "
            "mm\"]\nholds = \"x\"\n" STAGE "[[stage.servo]]\ntool = \"hand\"\nforce = \"1 N\"\n",
            "servo[0].tool", "is a constraint"},
        Wrong{"ServoAgainstAMove",
              STAGE "[[stage.servo]]\ntool = \"top\"\nforce = \"1 N\"\n[[stage.move]]\ntool = "
                    "\"top\"\ndisplacement = [\"0 mm\", \"-1 mm\"]\n",
              "servo[0].tool", "is moved along its servo's direction"},
        Wrong{"ShareOfASine",
              PROFILE "relief = \"sine\"\npitch = \"1 mm\"\nra = \"1 um\"\nflat_share = 0.2\n",
              "flat_share", "trapezoid"}),
    [](const auto& one) { return std::string(one.param.name); });

}  // namespace
}  // namespace pulvis
