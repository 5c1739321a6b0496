// Random packings as scenes ask for them: as dense as wanted, without overlaps, the same for the same
// seed, of the particles that the mixture says.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

#include "scenes/checks/overlaps.hpp"
#include "scenes/outlines/outline.hpp"
#include "scenes/packing/place.hpp"
#include "tests/helpers/experiment.hpp"
#include "tests/helpers/random_scene.hpp"
#include "tests/helpers/wrong.hpp"

namespace pulvis {
namespace {

struct Case {
  const char* name;
  const char* width;
  std::vector<RandomClass> classes;
  double minimum = 0.76;  // density at which it rests
};
void PrintTo(const Case& c, std::ostream* stream) { *stream << c.name; }

const Case thesis[] = {
    {"Large", "100 mm", {{"large", "number = 100"}}},
    {"LargeAndSmall", "80 mm", {{"large", "number = 50"}, {"small", "number = 50"}}},
    {"Small", "40 mm", {{"small", "number = 100"}}},
    {"SemiRectangles", "130 mm", {{"semi", "number = 100"}}},
    {"DiscsAndSemiRectangles", "110 mm", {{"large", "number = 50"}, {"semi", "number = 50"}}}};
// Columns of squares, or of hooks, that stand on flat sides hold a punch up early.
const Case others[] = {
    {"Squares", "100 mm", {{"square", "number = 60"}}, 0.7},
    {"Ellipses", "100 mm", {{"ellipse", "number = 60"}}},
    {"Hooks", "100 mm", {{"hook", "number = 40"}}, 0.7},
    {"All",
     "100 mm",
     {{"hook", "number = 15"}, {"ellipse", "number = 15"}, {"square", "number = 15"}}}};

Scene packed(const Case& c, const std::string& density, int seed = 1) {
  const std::string die = fmt::format("width = \"{}\"\ndensity = {}", c.width, density);
  const std::string text = fmt::format("seed = {}\n", seed) + random_scene(die, c.classes, c.width);
  return load_scene_text(text, "random.toml").scene;
}

const Outline& outline_of(const Scene& scene, const BodySpec& body) {
  return scene.particles[static_cast<std::size_t>(body.particle)].outline;
}

std::vector<Vec2> points_of(const Scene& scene, const BodySpec& body) {
  std::vector<Vec2> points;
  for (const Vec2& p : outline_polygon(outline_of(scene, body), 2e-6))
    points.push_back(in_plane(body.position) + Eigen::Rotation2Dd(body.angle) * p);
  return points;
}

bool inside(const std::vector<Vec2>& polygon, const Vec2& p) {
  bool in = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    if ((a.y() > p.y()) != (b.y() > p.y()) &&
        p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
      in = !in;
  }
  return in;
}

// No fine point of one outline lies in another one or outside of the die: every pair is looked at.
void expect_no_overlap(const Scene& scene) {
  const std::vector<BodySpec> bodies = place_bodies(scene);
  const PackingSpec& packing = scene.packings.at(0);
  std::vector<std::vector<Vec2>> outlines;
  for (const BodySpec& body : bodies) outlines.push_back(points_of(scene, body));
  int overlaps = 0, outside = 0;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    for (const Vec2& p : outlines[i])
      outside += p.x() < 0 || p.x() > packing.container.width || p.y() < 0 || p.y() > packing.top;
    for (std::size_t k = 0; k < bodies.size(); ++k)
      if (i != k && (bodies[i].position - bodies[k].position).norm() < 0.03)
        for (const Vec2& p : outlines[i]) overlaps += inside(outlines[k], p);
  }
  EXPECT_EQ(overlaps, 0);
  EXPECT_EQ(outside, 0);
}

double density_of(const Scene& scene) {
  double area = 0;
  for (const BodySpec& body : place_bodies(scene)) area += outline_area(outline_of(scene, body));
  return area / (scene.packings.at(0).container.width * scene.packings.at(0).top);
}

class RandomPackings : public testing::TestWithParam<Case> {};

TEST_P(RandomPackings, AreAsDenseAsWantedAndFreeOfOverlap) {
  for (const char* wanted : {"0.66", "0.75"}) {
    const Scene scene = packed(GetParam(), wanted);
    EXPECT_NEAR(density_of(scene), std::stod(wanted), 1e-9);
    EXPECT_NEAR(scene.packings.at(0).reached.density, density_of(scene), 1e-9);
    EXPECT_EQ(scene.tools.at(3).point.y(), scene.packings.at(0).top);
    expect_no_overlap(scene);
    EXPECT_NO_THROW(check_overlaps(scene, place_bodies(scene)));
  }
}

TEST_P(RandomPackings, TouchAtLess2PercentOfADiameter) {
  const Scene scene = packed(GetParam(), "\"touching\"");
  EXPECT_LT(scene.packings.at(0).reached.mean_gap, 0.02);
  EXPECT_GT(scene.packings.at(0).reached.density, GetParam().minimum);
  EXPECT_NEAR(scene.packings.at(0).reached.density, density_of(scene), 1e-9);
  expect_no_overlap(scene);
}

const auto name_of = [](const auto& info) { return info.param.name; };
INSTANTIATE_TEST_SUITE_P(Thesis, RandomPackings, testing::ValuesIn(thesis), name_of);
INSTANTIATE_TEST_SUITE_P(Others, RandomPackings, testing::ValuesIn(others), name_of);

TEST(RandomPacking, FollowsTheSeedAlone) {
  const Scene a = packed(thesis[4], "0.8", 7), b = packed(thesis[4], "0.8", 7);
  const Scene c = packed(thesis[4], "0.8", 8);
  bool differs = false;
  for (std::size_t i = 0; i < 100; ++i) {
    const BodySpec &p = a.packings[0].placed[i], &q = b.packings[0].placed[i];
    EXPECT_EQ(p.position, q.position);
    EXPECT_EQ(p.angle, q.angle);
    differs |= p.position != c.packings[0].placed[i].position;
  }
  EXPECT_TRUE(differs);
}

// Frictionless discs of two sizes, 1 : 1.4, jam at 0.842 (O'Hern 2003); without order, and isostatically: as many
// touches as directions to move in, four of each disc that is held. Walls, which keep half a diameter
// emptier, and a margin between the touching cost some of it, rattlers some touches.
TEST(RandomPacking, TwoSizesJamWhereKnown) {
  const Case c{"", "300 mm", {{"large", "number = 500"}, {"middle", "number = 500"}}};
  const PackingSpec packing = packed(c, "\"touching\"").packings.at(0);
  EXPECT_NEAR(packing.reached.density, 0.842, 0.03);
  EXPECT_NEAR(2.0 * packing.reached.touches / 1000, 3.7, 0.4);
}

TEST(RandomPacking, ShakingOnMakesDenser) {
  const double touching = packed(thesis[3], "\"touching\"").packings.at(0).reached.density;
  const Scene densest = packed(thesis[3], "\"densest\"");
  EXPECT_GT(densest.packings.at(0).reached.density, touching);
  EXPECT_NEAR(densest.packings.at(0).reached.density, density_of(densest), 1e-9);
  expect_no_overlap(densest);
}

// Spread over the die: shaken evenly, no quarter of a loose packing is empty.
TEST(RandomPacking, FillsTheDieEvenly) {
  const Scene scene = packed({"", "200 mm", {{"large", "number = 400"}}}, "0.7");
  int quarter[4] = {};
  for (const BodySpec& body : scene.packings.at(0).placed)
    ++quarter[(body.position.x() > 0.1 ? 1 : 0) +
              (body.position.y() > scene.packings[0].top / 2 ? 2 : 0)];
  for (const int count : quarter) EXPECT_NEAR(count, 100, 12);
}

TEST(RandomPacking, CountFollowsFromHeightAndDensity) {
  const std::string die = "width = \"80 mm\"\nheight = \"90 mm\"\ndensity = 0.7";
  const Scene scene =
      load_scene_text(
          random_scene(die,
                       {{"large", "number_fraction = 0.5"}, {"small", "number_fraction = 0.5"}},
                       "80 mm"),
          "random.toml")
          .scene;
  const double mean_area = std::numbers::pi / 4 * (100e-6 + 16e-6) / 2;
  EXPECT_EQ(scene.packings.at(0).placed.size(),
            static_cast<std::size_t>(0.7 * 0.08 * 0.09 / mean_area + 0.5));
  EXPECT_EQ(scene.tools.at(3).point.y(), 0.09);
  // Half a particle more or less, and of two classes one more of this than of that.
  EXPECT_NEAR(scene.packings[0].reached.density, 0.7, 2 * mean_area / (0.08 * 0.09));
  expect_no_overlap(scene);
}

TEST(RandomPacking, AreaFractionsAreKept) {
  const std::string die = "width = \"100 mm\"\ncount = 290\ndensity = 0.7";
  const Scene scene =
      load_scene_text(
          random_scene(die, {{"large", "area_fraction = 0.5"}, {"small", "area_fraction = 0.5"}},
                       "100 mm"),
          "random.toml")
          .scene;
  const auto large = std::ranges::count(scene.packings.at(0).placed, 0, &BodySpec::particle);
  EXPECT_EQ(large, 40);  // 40 * 100 = 250 * 16
  EXPECT_EQ(scene.packings[0].placed.size(), 290U);
}

// The densest packing of these discs in this die is known to be below 0.9069.
TEST(RandomPacking, RefusesADensityOutOfReach) {
  const auto problems = problems_in([] { packed(thesis[0], "0.93"); });
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].key, "packing[0].density");
  EXPECT_EQ(problems[0].line, 20);
  EXPECT_EQ(problems[0].column, 11);
  EXPECT_THAT(problems[0].message,
              testing::ContainsRegex("0.9300 cannot be reached: .* allowed: at most 0.8[0-9]+"));
}

// Rough meshes, friction, four tools: the punch meets particles one after the other.
TEST(RandomPacking, IsCompactedWithoutLosingEnergy) {
  const std::string die = "width = \"40 mm\"\ndensity = \"touching\"";
  std::string text = "accuracy = \"draft\"\n" +
                     random_scene(die, {{"large", "number = 8"}, {"semi", "number = 6"}}, "40 mm");
  Experiment e(load_scene_text(text, "random.toml").scene);
  e.run(50);
  EXPECT_LT(e.results.energy_balance_error(), 0.01);
  EXPECT_GT(std::abs(e.value("tool/top/force_y")), 100);
  EXPECT_NEAR(e.value("relative_density") / e.scene.packings.at(0).reached.density,
              e.scene.packings[0].top / (e.scene.packings[0].top - 0.002), 0.01);
}

}  // namespace
}  // namespace pulvis
