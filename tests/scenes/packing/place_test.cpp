// Placement: where particles stand, that touching is accepted, and that overlaps are found with
// their depth. Depths are compared with closed forms.
#include "scenes/packing/place.hpp"
#include "scenes/checks/overlaps.hpp"
#include "scenes/read.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "tests/helpers/shipped_scenes.hpp"
#include "tests/helpers/wrong.hpp"

namespace pulvis {
namespace {

using std::numbers::sqrt2;
using testing::HasSubstr;

constexpr double size = 0.01;  // m, of every particle here

ParticleSpec disc() {
  ParticleSpec particle;
  particle.name = "disc";
  particle.outline = DiscOutline{size};
  return particle;
}

ParticleSpec square() {
  ParticleSpec particle;
  particle.name = "square";
  particle.outline = RectangleOutline{size, size};
  particle.mesh = RectangleMesh{};
  return particle;
}

constexpr double corner_radius = 2e-3;

ParticleSpec rounded() {
  ParticleSpec particle;
  particle.name = "rounded";
  particle.outline = RoundedRectangleOutline{2 * size, size, corner_radius};
  particle.mesh = RoundedRectangleMesh{};
  return particle;
}

ParticleSpec ring() {
  ParticleSpec particle;
  particle.name = "ring";
  particle.outline = RingOutline{size, size / 2};
  particle.mesh = RingMesh{};
  return particle;
}

BodySpec at(double x, double y, int particle = 0, double angle = 0) {
  BodySpec body;
  body.particle = particle;
  body.position = Vec3(x, y, 0);
  body.angle = angle;
  return body;
}

ToolSpec plane(const std::string& name, const Vec2& point, const Vec2& normal) {
  ToolSpec tool;
  tool.name = name;
  tool.point = in_space(point);
  tool.normal = in_space(normal.normalized());
  return tool;
}

Scene scene_of(std::vector<BodySpec> bodies) {
  Scene scene;
  scene.file = "place.toml";
  scene.particles = {disc(), square(), rounded(), ring()};
  scene.bodies = std::move(bodies);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    scene.bodies[i].mark = {static_cast<int>(10 * (i + 1)), 1};
  return scene;
}

std::vector<SceneProblem> problems_of(const Scene& scene) {
  return problems_in([&] { check_overlaps(scene, place_bodies(scene)); });
}

Scene die(int rows, int columns, Vec2 corner) {
  Scene scene = scene_of({});
  PackingSpec packing;
  packing.cells[1] = rows;
  packing.cells[0] = columns;
  packing.spacing = size;
  packing.container.corner = in_space(corner);
  packing.mark = {7, 1};
  scene.packings = {packing};
  const Vec2 far_corner = corner + size * Vec2(columns, rows);
  scene.tools = {plane("left", corner, {1, 0}), plane("bottom", corner, {0, 1}),
                 plane("right", far_corner, {-1, 0}), plane("top", far_corner, {0, -1})};
  return scene;
}

// Off their places by no more than is said, evenly over the circle, and by the seed alone.
TEST(PerturbedLattice, MovesCentresWithinTheirCircles) {
  Scene scene;
  scene.particles = {disc()};
  PackingSpec packing;
  packing.cells = {40, 40, 0};
  packing.spacing = 1.1 * size;
  scene.packings = {packing};
  const std::vector<BodySpec> regular = place_bodies(scene);
  scene.packings[0].perturbation = 0.04;
  const std::vector<BodySpec> moved = place_bodies(scene), again = place_bodies(scene);
  scene.seed = 2;
  const std::vector<BodySpec> other = place_bodies(scene);
  const double radius = 0.04 * packing.spacing;
  double squares = 0;
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < regular.size(); ++i) {
    const Vec3 way = (moved[i].position - regular[i].position) / radius;
    EXPECT_LE(way.norm(), 1);
    EXPECT_EQ(moved[i].position, again[i].position);
    EXPECT_NE(moved[i].position, other[i].position);
    squares += way.squaredNorm() / static_cast<double>(regular.size());
    sum += way / static_cast<double>(regular.size());
  }
  EXPECT_NEAR(squares, 0.5, 0.03);  // of a circle of radius 1
  EXPECT_LT(sum.norm(), 0.05);
}

TEST(PerturbedLattice, MovesCentresWithinTheirBalls) {
  Scene scene;
  scene.dimension = 3;
  PackingSpec packing;
  packing.kind = PackingSpec::Kind::cubic;
  packing.cells = {12, 12, 12};
  packing.spacing = 1.1 * size;
  scene.packings = {packing};
  const std::vector<BodySpec> regular = place_bodies(scene);
  scene.packings[0].perturbation = 0.04;
  const std::vector<BodySpec> moved = place_bodies(scene), again = place_bodies(scene);
  const double radius = 0.04 * packing.spacing;
  Vec3 squares = Vec3::Zero(), sum = Vec3::Zero();
  for (std::size_t i = 0; i < regular.size(); ++i) {
    const Vec3 way = (moved[i].position - regular[i].position) / radius;
    EXPECT_LE(way.norm(), 1);
    EXPECT_EQ(moved[i].position, again[i].position);
    squares += way.cwiseAbs2() / static_cast<double>(regular.size());
    sum += way / static_cast<double>(regular.size());
  }
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(squares[k], 0.2, 0.02);  // of a ball of radius 1
  EXPECT_LT(sum.norm(), 0.05);
}

TEST(PlaceBodies, APackingIsFilledRowByRowFromTheBottom) {
  const auto bodies = place_bodies(die(2, 3, Vec2(1, 2)));
  ASSERT_EQ(bodies.size(), 6U);
  EXPECT_TRUE(bodies[0].position.isApprox(Vec3(1.005, 2.005, 0), 1e-15));
  EXPECT_TRUE(bodies[1].position.isApprox(Vec3(1.015, 2.005, 0), 1e-15));
  EXPECT_TRUE(bodies[3].position.isApprox(Vec3(1.005, 2.015, 0), 1e-15));
  EXPECT_EQ(bodies[5].mark.line, 7);
}

Scene hexagonal(int rows, int columns, Vec2 corner) {
  Scene scene = die(rows, columns, corner);
  scene.packings[0].kind = PackingSpec::Kind::hexagonal;
  const double height = size * (1 + (rows - 1) * std::numbers::sqrt3 / 2);
  scene.tools[3].point = in_space(corner + Vec2(columns * size, height));
  return scene;
}

TEST(PlaceBodies, HexagonalRowsLieInTheGapsOfThoseBelow) {
  const Vec2 corner(1, 2);
  const auto bodies = place_bodies(hexagonal(4, 3, corner));
  ASSERT_EQ(bodies.size(), 10U);  // 3 + 2 + 3 + 2
  const auto position = [&](std::size_t i) {
    return Vec2((in_plane(bodies[i].position) - corner) / size);
  };
  const double rise = std::sqrt(0.75);
  EXPECT_TRUE(position(0).isApprox(Vec2(0.5, 0.5), 1e-12));
  EXPECT_TRUE(position(3).isApprox(Vec2(1, 0.5 + rise), 1e-12));
  EXPECT_TRUE(position(5).isApprox(Vec2(0.5, 0.5 + 2 * rise), 1e-12));
  EXPECT_TRUE(position(9).isApprox(Vec2(2, 0.5 + 3 * rise), 1e-12));
}

TEST(PlaceBodies, AHexagonalPackingIsItsOwnMirrorImageBetweenTheWalls) {
  const int columns = 7;
  const auto bodies = place_bodies(hexagonal(5, columns, Vec2::Zero()));
  for (const BodySpec& body : bodies) {
    const Vec3 mirrored(columns * size - body.position.x(), body.position.y(), 0);
    EXPECT_TRUE(std::ranges::any_of(
        bodies, [&](const BodySpec& b) { return (b.position - mirrored).norm() < 1e-12; }));
  }
}

// Inside a hexagonal packing everybody touches six others, and nobody stands nearer.
TEST(PlaceBodies, InAHexagonalPackingEverybodyInsideTouchesSix) {
  const auto bodies = place_bodies(hexagonal(34, 50, Vec2::Zero()));
  ASSERT_EQ(bodies.size(), 1683U);
  int inside = 0;
  for (const BodySpec& a : bodies) {
    int touching = 0;
    for (const BodySpec& b : bodies) {
      const double distance = (a.position - b.position).norm();
      if (&a == &b || distance > 1.5 * size) continue;
      EXPECT_NEAR(distance, size, 1e-12);
      ++touching;
    }
    EXPECT_LE(touching, 6);
    inside += touching == 6 ? 1 : 0;
  }
  EXPECT_EQ(inside, 16 * (50 - 2) + 16 * (49 - 2));  // all but the outermost rows and ends
}

TEST(PlaceBodies, CountsWithoutPlacing) {
  for (int rows = 1; rows <= 4; ++rows) {
    const Scene scene = hexagonal(rows, 5, Vec2::Zero());
    EXPECT_EQ(particle_count(scene.packings[0]),
              static_cast<std::int64_t>(place_bodies(scene).size()));
  }
  EXPECT_EQ(particle_count(die(3, 5, Vec2::Zero()).packings[0]), 15);
}

TEST(CheckOverlaps, AHexagonalPackingTouchesAndFitsItsDie) {
  for (const Vec2& corner : {Vec2(0, 0), Vec2(-0.3, 7.7)}) {
    Scene scene = hexagonal(9, 11, corner);
    EXPECT_TRUE(problems_of(scene).empty());
    scene.tools[3].point.y() -= 1e-5;
    EXPECT_THAT(problems_of(scene).at(0).message, HasSubstr("1e-05 m behind tool 'top'"));
  }
}

TEST(PlaceBodies, BodiesAndPackingsKeepTheOrderOfTheFile) {
  Scene scene = scene_of({at(1, 1), at(2, 2)});
  PackingSpec packing;
  packing.spacing = size;
  packing.mark = {15, 1};
  scene.packings = {packing};
  const auto bodies = place_bodies(scene);
  ASSERT_EQ(bodies.size(), 3U);
  EXPECT_EQ(bodies[0].position, Vec3(1, 1, 0));
  EXPECT_EQ(bodies[1].mark.line, 15);
  EXPECT_EQ(bodies[2].position, Vec3(2, 2, 0));
}

TEST(PlaceBodies, TheTextOfASceneKeepsThatOrder) {
  const std::string start = R"(family = "compaction"
[[material]]
name = "m"
density = "1 kg/m^3"
youngs_modulus = "1 GPa"
poissons_ratio = 0
[[particle]]
name = "p"
material = "m"
outline = "disc"
diameter = "1 mm"
[[body]]
particle = "p"
position = ["5 m", "1 m"]
[[packing]]
kind = "square"
particle = "p"
rows = 1
columns = 2
[[body]]
particle = "p"
position = ["6 m", "1 m"]
[[stage]]
name = "s"
kind = "settle"
duration = "1 s"
)";
  const LoadedScene first = load_scene_text(start, "a.toml");
  const auto before = place_bodies(first.scene);
  const auto after = place_bodies(load_scene_text(first.text, "b.toml").scene);
  ASSERT_EQ(before.size(), 4U);
  ASSERT_EQ(after.size(), 4U);
  EXPECT_EQ(before[3].position.x(), 6);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(before[i].position, after[i].position);
}

TEST(CheckOverlaps, EveryShippedSceneHasRoom) {
  for (const auto& file : shipped_scenes()) {
    const Scene scene = read_scene(file);
    if (scene.afm) continue;
    const std::vector<BodySpec> bodies = place_bodies(scene);
    EXPECT_NO_THROW(check_overlaps(scene, bodies)) << file;
  }
}

TEST(CheckOverlaps, TouchingIsAcceptedWhereverThePackingLies) {
  for (const double shift : {0.0, 0.1, -0.3, 1.0 / 3, 7.7})
    EXPECT_TRUE(problems_of(die(10, 10, Vec2(shift, -shift))).empty()) << shift;
}

TEST(CheckOverlaps, DiscsJustAboveTheToleranceAreRefused) {
  EXPECT_TRUE(problems_of(scene_of({at(0, 0), at(size * (1 - 0.5e-9), 0)})).empty());
  EXPECT_EQ(problems_of(scene_of({at(0, 0), at(size * (1 - 2e-9), 0)})).size(), 1U);
}

TEST(CheckOverlaps, NamesBothParticlesTheDepthAndThePlace) {
  const auto problems = problems_of(scene_of({at(0, 0), at(0.5, 0), at(0.006, 0)}));
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].line, 30);
  EXPECT_EQ(problems[0].key, "body[2].position");
  EXPECT_THAT(problems[0].text(),
              HasSubstr("place.toml:30:1: body[2].position: particle 2 ('disc' at "
                        "(0.006, 0) m) overlaps particle 0 ('disc' at (0, 0) m) by "
                        "0.004 m, allowed: particles that touch or are apart"));
}

TEST(CheckOverlaps, ADenseListIsCutShort) {
  const auto problems = problems_of(scene_of(std::vector<BodySpec>(20, at(0, 0))));
  ASSERT_EQ(problems.size(), 21U);
  EXPECT_THAT(problems.back().message, HasSubstr("more overlaps"));
}

TEST(CheckOverlaps, DiscBehindAndAcrossATool) {
  Scene scene = scene_of({at(0, 0.004), at(0.1, -1), at(0.2, 0.005)});
  scene.tools = {plane("floor", Vec2::Zero(), {0, 1})};
  const auto problems = problems_of(scene);
  ASSERT_EQ(problems.size(), 2U);
  EXPECT_THAT(problems[0].message,
              HasSubstr("particle 0 ('disc' at (0, 0.004) m) is outside the die: it "
                        "reaches 0.001 m behind tool 'floor'"));
  EXPECT_THAT(problems[1].message, HasSubstr("1.005 m behind tool 'floor'"));
}

TEST(CheckOverlaps, ObliqueTools) {
  Scene scene = scene_of({at(0, 0)});
  scene.tools = {plane("slope", Vec2(0, -size / sqrt2), {1, 1})};
  EXPECT_TRUE(problems_of(scene).empty());  // touches: distance size/2
  scene.tools = {plane("slope", Vec2(0, 0), {1, 1})};
  ASSERT_EQ(problems_of(scene).size(), 1U);
  EXPECT_THAT(problems_of(scene)[0].message, HasSubstr("reaches 0.005 m behind"));
}

TEST(CheckOverlaps, RectanglesAndTools) {
  Scene scene = scene_of({at(0, size / 2, 1)});
  scene.tools = {plane("floor", Vec2::Zero(), {0, 1})};
  EXPECT_TRUE(problems_of(scene).empty());
  scene.bodies[0].angle = std::numbers::pi / 4;  // stands on a corner, which is size/sqrt(2) away
  ASSERT_EQ(problems_of(scene).size(), 1U);
  EXPECT_THAT(problems_of(scene)[0].message, HasSubstr("reaches 0.00207107 m behind"));
}

TEST(CheckOverlaps, RectanglesTouchingAndOverlapping) {
  EXPECT_TRUE(problems_of(scene_of({at(0, 0, 1), at(size, 0, 1)})).empty());
  EXPECT_TRUE(problems_of(scene_of({at(0.3, 0.7, 1), at(0.3 + size / 3, 0.7 + size, 1)})).empty());
  const auto shallow = problems_of(scene_of({at(0, 0, 1), at(size - 1e-6, 0.002, 1)}));
  ASSERT_EQ(shallow.size(), 1U);
  EXPECT_THAT(shallow[0].message, HasSubstr("by 1e-06 m"));
  const auto tiny = problems_of(scene_of({at(0, 0, 1), at(size * (1 - 1e-8), 0, 1)}));
  EXPECT_EQ(tiny.size(), 1U);
}

TEST(CheckOverlaps, ATurnedSquareTouchesWithItsCorner) {
  const double reach = size / 2 + size / sqrt2;
  const double eighth = std::numbers::pi / 4;
  EXPECT_TRUE(problems_of(scene_of({at(0, 0, 1), at(reach, 0, 1, eighth)})).empty());
  const auto problems = problems_of(scene_of({at(0, 0, 1), at(reach - 1e-4, 0, 1, eighth)}));
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_THAT(problems[0].message, HasSubstr("by 0.0001 m"));
}

TEST(CheckOverlaps, DiscAgainstRectangle) {
  const double side = size;                // disc beside the square
  const double corner = size / 2 / sqrt2;  // disc at its corner, along the diagonal
  const Vec2 diagonal = Vec2::Constant(size / 2 + corner);
  EXPECT_TRUE(problems_of(scene_of({at(0, 0, 1), at(side, 0)})).empty());
  EXPECT_TRUE(problems_of(scene_of({at(0, 0, 1), at(diagonal.x(), diagonal.y())})).empty());
  EXPECT_THAT(problems_of(scene_of({at(0, 0, 1), at(side - 1e-5, 0.001)})).at(0).message,
              HasSubstr("by 1e-05 m"));
  EXPECT_THAT(problems_of(scene_of({at(0, 0), at(0.001, 0, 1)})).at(0).message,
              HasSubstr("by 0.009 m"));
}

// Depth of the one overlap of two particles, or 0.
double depth_of(const BodySpec& a, const BodySpec& b) {
  const auto problems = problems_of(scene_of({a, b}));
  if (problems.empty()) return 0;
  EXPECT_EQ(problems.size(), 1U);
  const std::string& message = problems[0].message;
  return std::stod(message.substr(message.find(" by ") + 4));
}

TEST(CheckOverlaps, RoundedRectanglesTouchAtSidesAndAtCorners) {
  const double d = 1e-5;
  EXPECT_EQ(depth_of(at(0, 0, 2), at(2 * size, 0, 2)), 0);  // side to side
  EXPECT_NEAR(depth_of(at(0, 0, 2), at(2 * size - d, 1e-3, 2)), d, 1e-9);
  // Corner to corner along the diagonal: the centres of the arcs are two radii apart.
  const Vec2 corner =
      Vec2(2 * size, size) + Vec2::Constant(-2 * corner_radius + sqrt2 * corner_radius);
  const Vec2 back = Vec2::Constant(d / sqrt2);
  EXPECT_EQ(depth_of(at(0, 0, 2), at(corner.x(), corner.y(), 2)), 0);
  EXPECT_NEAR(depth_of(at(0, 0, 2), at(corner.x() - back.x(), corner.y() - back.y(), 2)), d, 1e-9);
  // One turned by 45 degrees, its corner on the other's side.
  const double reach = size / 2 + (size + size / 2 - 2 * corner_radius) / sqrt2 + corner_radius;
  const double eighth = std::numbers::pi / 4;
  EXPECT_EQ(depth_of(at(0, 0, 2), at(0, reach, 2, eighth)), 0);
  EXPECT_NEAR(depth_of(at(0, 0, 2), at(0, reach - d, 2, eighth)), d, 1e-9);
  // Deep inside: the way out is the height.
  EXPECT_NEAR(depth_of(at(0, 0, 2), at(1e-4, 1e-3, 2)), size - 1e-3, 1e-8);
}

TEST(CheckOverlaps, RoundedRectangleAgainstDiscRectangleAndRing) {
  const double d = 1e-5;
  // A disc's centre stands beyond the arc's centre by both radii.
  const Vec2 arc(size - corner_radius, size / 2 - corner_radius);
  const Vec2 centre = arc + Vec2::Constant((size / 2 + corner_radius) / sqrt2);
  EXPECT_EQ(depth_of(at(0, 0, 2), at(centre.x(), centre.y())), 0);
  EXPECT_NEAR(depth_of(at(0, 0, 2), at(centre.x() - d / sqrt2, centre.y() - d / sqrt2)), d, 1e-9);
  EXPECT_NEAR(depth_of(at(0, 0, 2), at(centre.x() - d / sqrt2, centre.y() - d / sqrt2, 3)), d,
              1e-9);
  EXPECT_EQ(depth_of(at(0, 0, 2), at(0, size, 1)), 0);
  EXPECT_NEAR(depth_of(at(0, 0, 2), at(0, size - d, 1)), d, 1e-9);
  // What lies in the hole lies in the ring: only its outer circle counts.
  EXPECT_GT(depth_of(at(0, 0, 3), at(0, 0, 3)), 0.9 * size);
}

TEST(CheckOverlaps, RoundedCornerBehindATool) {
  const double reach = (size + size / 2 - 2 * corner_radius) / sqrt2 + corner_radius;
  Scene scene = scene_of({at(0, reach, 2, std::numbers::pi / 4)});
  scene.tools = {plane("floor", Vec2::Zero(), Vec2::UnitY())};
  EXPECT_TRUE(problems_of(scene).empty());
  scene.bodies[0].position.y() -= 1e-5;
  EXPECT_THAT(problems_of(scene).at(0).message, HasSubstr("1e-05 m behind tool 'floor'"));
}

TEST(CheckOverlaps, SizesThatDifferByManyOrders) {
  Scene scene = scene_of({at(0, 0), at(0.005 + 1e-9, 0, 1)});
  scene.particles[1].outline =
      DiscOutline{2e-9};  // smaller ones are refused this far from the origin
  EXPECT_TRUE(problems_of(scene).empty());
}

// A disc of a square lattice touches four, and its box the corners of four more boxes: a pair for either half of them.
TEST(CheckOverlaps, LooksAtNeighboursOnlyAmongTenThousandParticles) {
  constexpr std::size_t side = 100, touching = 2 * side * (side - 1),
                        at_corners = 2 * (side - 1) * (side - 1);
  const Scene scene = die(side, side, Vec2::Zero());
  const std::size_t pairs = check_overlaps(scene, place_bodies(scene));
  EXPECT_LE(pairs, touching + at_corners);
  EXPECT_GT(pairs, touching / 4);  // round-off parts some of the boxes
}

}  // namespace
}  // namespace pulvis
