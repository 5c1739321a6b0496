// Nothing passes through anything unseen, however fast: what meets rebounds, or stays before what it met, or the
// run stops and says why.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "engine/run_failure.hpp"
#include "scenes/meshes/thinnest.hpp"
#include "tests/helpers/experiment.hpp"
#include "tests/helpers/wrong.hpp"

namespace pulvis {
namespace {

using ::testing::ContainsRegex;

// A jelly in which sound runs at 12 m/s: its stable step is 50 us long, in which 1000 m/s are 50 mm.
constexpr const char* jelly = R"(family = "compaction"
title = "fast and soft"

[[material]]
name = "jelly"
density = "1000 kg/m^3"
youngs_modulus = "100 kPa"
poissons_ratio = 0.3

)";

// Those that a scene uses.
const std::pair<const char*, const char*> particles[] = {{"disc", R"(outline = "disc"
diameter = "10 mm"
mesh = {boundary_edges = 40, rings = 1}
)"},
                                                         {"plate", R"(outline = "rectangle"
width = "0.5 mm"
height = "20 mm"
)"}};

std::string body(const char* particle, const std::string& position, const std::string& velocity) {
  return std::string("[[body]]\nparticle = \"") + particle + "\"\nposition = " + position +
         "\nvelocity = " + velocity + "\n\n";
}
std::string to_the_right(double speed) {
  return "[\"" + std::to_string(speed) + " m/s\", \"0 m/s\"]";
}
std::string downwards(double speed) {
  return "[\"0 m/s\", \"-" + std::to_string(speed) + " m/s\"]";
}

// Of a way that is twice that through all there is.
std::string settle(double speed) {
  return "[[stage]]\nname = \"fly\"\nkind = \"settle\"\nduration = \"" +
         std::to_string(40e3 / speed) + " us\"\n\n";
}
std::string tool(const char* name, const char* points) {
  return std::string("[[tool]]\nname = \"") + name +
         "\"\nshape = \"polyline\"\npoints = " + points + "\n\n";
}
constexpr const char* blade =
    "[[\"-40 mm\", \"-10 mm\"], [\"-0.05 mm\", \"-10 mm\"], [\"-0.05 mm\", \"10 mm\"], "
    "[\"0.05 mm\", \"10 mm\"], [\"0.05 mm\", \"-10 mm\"], [\"40 mm\", \"-10 mm\"]]";
constexpr const char* spike =
    "[[\"-40 mm\", \"-10 mm\"], [\"-0.2 mm\", \"-10 mm\"], [\"0 mm\", \"10 mm\"], "
    "[\"0.2 mm\", \"-10 mm\"], [\"40 mm\", \"-10 mm\"]]";

Experiment experiment(const std::string& text) {
  std::string scene = jelly;
  for (const auto& [name, outline] : particles)
    if (text.find(std::string("particle = \"") + name + "\"") != std::string::npos)
      scene +=
          std::string("[[particle]]\nname = \"") + name + "\"\nmaterial = \"jelly\"\n" + outline;
  return Experiment(load_scene_text(scene + text, "tunnelling.toml").scene);
}

// What stopped the run; nothing where it reached its end.
std::string run(Experiment& e) {
  return message_of<RunFailure>([&] { e.run(20); });
}

Vec2 middle(Experiment& e, int number) {
  const World& world = e.simulation.world();
  const Bodies& bodies = world.resource<Bodies>();
  const int slot = bodies.slot_of_number[static_cast<std::size_t>(number)];
  const auto& x = world.column<CurvePosition>();
  const int first = bodies.slots[static_cast<std::size_t>(slot)].first_control;
  const int count = bodies.shape_of_slot(slot).control_points();
  Vec2 sum = Vec2::Zero();
  for (int i = first; i < first + count; ++i)
    sum += Vec2(x.values()[2 * i], x.values()[2 * i + 1]) / count;
  return sum;
}

class Tunnelling : public ::testing::TestWithParam<double> {};

TEST_P(Tunnelling, NoDiscThroughADisc) {
  const double v = GetParam();
  Experiment e = experiment(body("disc", "[\"-12 mm\", \"1 mm\"]", to_the_right(v)) +
                            body("disc", "[\"0 mm\", \"0 mm\"]", to_the_right(0)) + settle(v));
  const std::string stopped = run(e);
  EXPECT_LT(middle(e, 0).x(), middle(e, 1).x()) << stopped;
  if (stopped.empty()) {
    EXPECT_GT(e.value("penetration"), 0);
  }
}

TEST_P(Tunnelling, NoDiscThroughAThinPlateNorAPlateThroughADisc) {
  const double v = GetParam();
  for (const bool plate_flies : {false, true}) {
    const char *one = plate_flies ? "plate" : "disc", *other = plate_flies ? "disc" : "plate";
    Experiment e = experiment(body(one, "[\"-12 mm\", \"0.3 mm\"]", to_the_right(v)) +
                              body(other, "[\"0 mm\", \"0 mm\"]", to_the_right(0)) + settle(v));
    const std::string stopped = run(e);
    if (stopped.empty()) {  // a plate that bends around the disc has its middle anywhere
      EXPECT_LT(middle(e, 0).x(), middle(e, 1).x()) << one;
      EXPECT_GT(e.value("penetration"), 0);
    }
  }
}

TEST_P(Tunnelling, NoDiscThroughABladeOrASpike) {
  const double v = GetParam();
  for (const char* points : {blade, spike}) {
    Experiment e = experiment(body("disc", "[\"-8 mm\", \"0 mm\"]", to_the_right(v)) +
                              tool("floor", points) + settle(v));
    const std::string stopped = run(e);
    EXPECT_LT(middle(e, 0).x(), 0) << stopped;
    if (stopped.empty()) {
      EXPECT_GT(e.value("penetration"), 0);
    }
  }
}

// From above, in the middle between two Gauss points of its outline.
TEST_P(Tunnelling, NoDiscIsImpaledUnseen) {
  const double v = GetParam();
  for (const char* points : {blade, spike}) {
    Experiment e = experiment(body("disc", "[\"0 mm\", \"16 mm\"]", downwards(v)) +
                              tool("floor", points) + settle(v));
    const std::string stopped = run(e);
    EXPECT_GT(middle(e, 0).y(), 10e-3 + 2e-3) << stopped;
  }
}

INSTANTIATE_TEST_SUITE_P(Speeds, Tunnelling, ::testing::Values(1, 10, 100, 1000, 10000));

// A punch that would be through the die in less than a step.
TEST(Tunnelling, OfAPunchWithinAStepIsStopped) {
  Experiment e("compaction/regular-25.toml", {"stage.press.duration=1e-15 s"});
  EXPECT_THAT(run(e), ContainsRegex("^(tool_contact|trial_stress|edge_contact): particle"));
}

// ---- how thin a tool is --------------------------------------------------------------------------------
constexpr double none = std::numeric_limits<double>::infinity();

TEST(ThinnestPart, OfABladeIsItsThickness) {
  const std::vector<Vec2> points{{-4, 0}, {-0.05, 0}, {-0.05, 5}, {0.05, 5}, {0.05, 0}, {4, 0}};
  EXPECT_NEAR(thinnest_part(points, 1, 1), 0.1, 1e-12);
  EXPECT_EQ(thinnest_part(points, 1, 0.05), none);  // not that thin
  EXPECT_EQ(thinnest_part(points, 6, 6), none);     // no ridge for edges so long
  // A slot of that width is none: there is powder in it.
  const std::vector<Vec2> slot{{-4, 0}, {-0.05, 0}, {-0.05, -5}, {0.05, -5}, {0.05, 0}, {4, 0}};
  EXPECT_EQ(thinnest_part(slot, 1, 1), none);
}

// At the resolution behind its tip: 2 r tan of half the angle, up to where the samples lie.
TEST(ThinnestPart, OfAWedgeIsThatBehindItsTip) {
  for (const double degrees : {2.0, 10.0, 30.0}) {
    const double half = 0.5 * degrees * std::numbers::pi / 180, h = 10;
    const std::vector<Vec2> points{
        {-20, 0}, {-h * std::tan(half), 0}, {0, h}, {h * std::tan(half), 0}, {20, 0}};
    const double expected = 2 * std::sin(half);
    EXPECT_GT(thinnest_part(points, 1, 1), 0.95 * expected) << degrees;
    EXPECT_LT(thinnest_part(points, 1, 1), 1.3 * expected) << degrees;
  }
}

TEST(ThinnestPart, OfAMeshIsNoMoreThanItsSmallestElement) {
  Experiment e("compaction/regular-25.toml");
  const Shape& shape = e.simulation.world().resource<Bodies>().shapes[0];
  const double thinnest = thinnest_part(shape);
  EXPECT_GT(thinnest, 0.1e-3);
  EXPECT_LT(thinnest, 10e-3 * std::numbers::pi / 40);
}

}  // namespace
}  // namespace pulvis
