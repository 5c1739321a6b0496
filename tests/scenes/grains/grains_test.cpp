// Grains against geometry: they fill the particle, share their faces and nodes, and are as long and as equal as asked.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "scenes/build.hpp"
#include "scenes/grains/cut_cells.hpp"
#include "scenes/grains/grains.hpp"
#include "scenes/meshes/mesh.hpp"
#include "scenes/outlines/curve_of.hpp"
#include "scenes/outlines/outline.hpp"
#include "scenes/packing/place.hpp"
#include "tests/helpers/crystal.hpp"
#include "tests/helpers/experiment.hpp"
#include "tests/helpers/wrong.hpp"

namespace pulvis {
namespace {

Scene of_grains(const std::string& outline, const std::string& grains,
                const std::string& head = "") {
  return own_scene(Crystal{.outline = outline,
                           .grains = "[particle.grains]\n" + grains,
                           .motion = "angle = \"30 deg\"",
                           .head = head}
                       .text());
}

struct Case {
  const char* name;
  const char* outline;
};
void PrintTo(const Case& made, std::ostream* out) { *out << made.name; }

class EveryOutline : public ::testing::TestWithParam<Case> {};

TEST_P(EveryOutline, IsFilledByItsGrains) {
  const Scene scene = of_grains(GetParam().outline, "number = 30");
  double area = 0, meshed = 0;
  for (const ParticleSpec& grain : scene.grains) {
    area += outline_area(grain.outline);
    const Shape shape = make_shape(grain);
    for (const auto& points : shape.gauss)
      for (const auto& point : points) meshed += point.determinant;
  }
  const double whole = outline_area(scene.particles[0].outline);
  EXPECT_NEAR(area, whole, 1e-9 * whole);
  EXPECT_NEAR(meshed, whole,
              2e-3 * whole);  // a polygon of the outline's area but at the faces' ends
  EXPECT_GE(scene.grains.size(), 25U);
}

// A node of a face is one of both grains: every node inside the particle is there at least twice.
TEST_P(EveryOutline, HasGrainsWithCommonNodes) {
  const Scene scene = of_grains(GetParam().outline, "number = 30");
  const auto& places = scene.particles[0].tessellations.at(0);
  const double whole = outline_area(scene.particles[0].outline), unit = 1e-9 * std::sqrt(whole);
  std::map<std::pair<long long, long long>, int> times;
  for (const GrainPlace& place : places) {
    const Shape shape = make_shape(scene.grains[static_cast<std::size_t>(place.grain)]);
    EXPECT_EQ(shape.boundary_nodes % 2, 0);
    for (int i = 0; i < shape.boundary_nodes; ++i) {
      const Point& p = shape.nodes[static_cast<std::size_t>(i)];
      times[{std::llround((p[0] + place.at.x()) / unit / 100),
             std::llround((p[1] + place.at.y()) / unit / 100)}] += 1;
    }
  }
  const OutlineCurve curve = any_curve(scene.particles[0].outline);
  int inside = 0, alone = 0;
  for (const auto& [at, count] : times) {
    const Vec2 node =
        100 * unit * Vec2(static_cast<double>(at.first), static_cast<double>(at.second));
    double nearest = 1e300;
    for (const auto& sample : curve.samples())
      nearest = std::min(nearest, (curve.at(sample.s).at - node).norm());
    if (nearest < 0.02 * std::sqrt(whole)) continue;
    ++inside;
    if (count < 2) ++alone;
  }
  EXPECT_GT(inside, 60);
  EXPECT_LE(alone, inside / 100);  // where rounding to the grid splits one
}

INSTANTIATE_TEST_SUITE_P(
    Grains, EveryOutline,
    ::testing::Values(
        Case{"disc", "outline = \"disc\"\ndiameter = \"10 mm\""},
        Case{"rectangle", "outline = \"rectangle\"\nwidth = \"10 mm\"\nheight = \"5 mm\""},
        Case{"rounded",
             "outline = \"rounded_rectangle\"\nwidth = \"9 mm\"\nheight = \"8 mm\"\nradius = "
             "\"1 mm\""},
        Case{"ellipse", "outline = \"ellipse\"\nwidth = \"10 mm\"\nheight = \"6 mm\""},
        Case{"hexagon", "outline = \"polygon\"\nsides = 6\ndiameter = \"10 mm\""},
        Case{"notched",
             "outline = \"polygon\"\ncorners = [[\"0 mm\", \"0 mm\"], [\"8 mm\", \"0 mm\"], "
             "[\"8 mm\", \"8 mm\"], [\"4 mm\", \"5 mm\"], [\"0 mm\", \"8 "
             "mm\"]]\nrounding = \"0.5 mm\""}),
    [](const auto& made) { return made.param.name; });

constexpr const char* disc = "outline = \"disc\"\ndiameter = \"10 mm\"";

// Standard deviation of the areas over their mean.
double spread(const Scene& scene) {
  double sum = 0, squares = 0;
  for (const ParticleSpec& grain : scene.grains) {
    const double area = outline_area(grain.outline);
    sum += area;
    squares += area * area;
  }
  const auto n = static_cast<double>(scene.grains.size());
  return std::sqrt(squares / n - sum / n * (sum / n)) / (sum / n);
}

// Of a Poisson-Voronoi tessellation it is 0.53 (Okabe et al. 2000), a little less in a small particle.
TEST(Grains, AreMoreEqualTheMoreTheyAreRelaxed) {
  const double random = spread(of_grains(disc, "number = 100\nrelaxation = 2"));
  const double relaxed = spread(of_grains(disc, "number = 100\nrelaxation = 50"));
  EXPECT_LT(random, 0.53);
  EXPECT_GT(random, 0.2);
  EXPECT_LT(relaxed, 0.15);
}

// Root mean square extent of the nodes along x over that along y.
double elongation(const Scene& scene) {
  double along = 0, across = 0;
  for (const ParticleSpec& grain : scene.grains) {
    const Shape shape = make_shape(grain);
    for (int i = 0; i < shape.boundary_nodes; ++i) {
      const Point& p = shape.nodes[static_cast<std::size_t>(i)];
      along += p[0] * p[0];
      across += p[1] * p[1];
    }
  }
  return std::sqrt(along / across);
}

TEST(Grains, AreAsLongAsAskedAndWhereAsked) {
  EXPECT_NEAR(elongation(of_grains(disc, "number = 80")), 1, 0.1);
  EXPECT_NEAR(elongation(of_grains(disc, "number = 80\naspect_ratio = 2")), 2, 0.25);
  EXPECT_NEAR(elongation(of_grains(disc, "number = 80\naspect_ratio = 2\ndirection = \"90 deg\"")),
              0.5, 0.07);
}

// Two halves, or slices of a disc: a chord and an arc each.
TEST(Grains, OfAFewPiecesFillTheParticle) {
  for (const char* number : {"number = 2", "number = 3", "number = 5"}) {
    const Scene scene = of_grains(disc, number);
    double area = 0;
    for (const ParticleSpec& grain : scene.grains) area += outline_area(grain.outline);
    EXPECT_NEAR(area, outline_area(scene.particles[0].outline), 1e-12) << number;
    EXPECT_EQ(fmt::format("number = {}", scene.grains.size()), number);
  }
}

TEST(Grains, AreTheSameForTheSameSeedOnly) {
  const auto first = [](const char* seed) {
    return outline_area(of_grains(disc, "number = 20", seed).grains.at(0).outline);
  };
  EXPECT_EQ(first("seed = 7"), first("seed = 7"));
  EXPECT_NE(first("seed = 7"), first("seed = 8"));
}

TEST(Grains, AreBodiesWithTheirParticlesNumberAndMotion) {
  Scene scene = of_grains(disc, "size = \"2 mm\"");
  scene.bodies[0].angular_velocity.z() = 10;
  scene.bodies.push_back(scene.bodies[0]);
  scene.bodies[1].position.x() += 20e-3;
  const std::vector<BodySpec> bodies = grains_of(scene, place_bodies(scene));
  ASSERT_EQ(bodies.size(), 50U);  // of (10/2)^2 each
  EXPECT_EQ(bodies[24].parent, 0);
  EXPECT_EQ(bodies[25].parent, 1);
  for (const BodySpec& body : bodies) {
    const Vec3 arm = body.position - scene.bodies[static_cast<std::size_t>(body.parent)].position;
    EXPECT_NEAR(body.velocity.x(), -10 * arm.y(), 1e-12);
    EXPECT_NEAR(body.velocity.y(), 10 * arm.x(), 1e-12);
  }
}

TEST(Grains, ThatCannotBeMadeAreRefused) {
  using ::testing::HasSubstr;
  const auto refused = [](const char* outline, const char* grains) {
    return message_of([&] { of_grains(outline, grains); });
  };
  EXPECT_THAT(refused(disc, "number = 20\nsize = \"1 mm\""),
              HasSubstr("neither or both of number and size"));
  EXPECT_THAT(refused(disc, "relaxation = 3"), HasSubstr("neither or both of number and size"));
  EXPECT_THAT(refused(disc, "size = \"1 um\""),
              HasSubstr("particle[0].grains.size: it gives more than 4096"));
  EXPECT_THAT(refused(disc, "size = \"20 mm\""), HasSubstr("2 to 4096 grains"));
  EXPECT_THAT(refused("outline = \"ring\"\ndiameter = \"10 mm\"\nhole = \"5 mm\"", "number = 20"),
              HasSubstr("a ring cannot be divided"));
  EXPECT_THAT(
      refused("outline = \"disc\"\ndiameter = \"10 mm\"\nmesh.boundary_edges = 48", "number = 20"),
      HasSubstr("particle[0].mesh.boundary_edges: has no effect on grains"));
}

}  // namespace
}  // namespace pulvis
