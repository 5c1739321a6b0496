// Random packings in three dimensions: as dense as wanted, without overlap and inside of the die, the same for the same
// seed, of the particles that the mixture says.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "scenes/meshes/hexahedra/star_surface.hpp"
#include "scenes/outlines/portable.hpp"
#include "tests/scenes/packing/solids/packed_scene.hpp"

namespace pulvis::space {
namespace {

using std::numbers::pi;
using testing::HasSubstr;

struct Case {
  const char* name;
  std::vector<ParticleShape> shapes;  // of about 10 mm
  std::vector<int> counts;
  double density;        // wanted
  double at_rest = 0.5;  // less than what it comes to rest at
};
void PrintTo(const Case& c, std::ostream* stream) { *stream << c.name; }

const SphereShape ball{10e-3};
const SuperquadricShape rounded_cube{{10e-3, 10e-3, 12e-3}, 5, 8};

// A cube cut off at one corner, not about its centre.
PolyhedronShape cut_cube(double rounding) {
  PolyhedronShape shape{.corners = {}, .rounding = rounding};
  for (const Vec3& p :
       {Vec3(0, 0, 0), Vec3(10, 0, 0), Vec3(0, 10, 0), Vec3(0, 0, 10), Vec3(10, 10, 0),
        Vec3(10, 0, 10), Vec3(0, 10, 10), Vec3(10, 10, 4), Vec3(10, 4, 10), Vec3(4, 10, 10)})
    shape.corners.push_back(1e-3 * p);
  return shape;
}

// An octahedron with a dent in each face: its hull is packed.
StlShape dented(double smoothing) {
  StlShape shape;
  shape.diameter = 10e-3;
  shape.smoothing = smoothing;
  for (int octant = 0; octant < 8; ++octant) {
    const Vec3 sign(octant & 1 ? -1 : 1, octant & 2 ? -1 : 1, octant & 4 ? -1 : 1);
    const Vec3 x(sign.x(), 0, 0), y(0, sign.y(), 0), z(0, 0, sign.z()), dent = 0.25 * sign;
    const bool outward = sign.prod() > 0;
    for (const auto& [a, b] : {std::pair(x, y), std::pair(y, z), std::pair(z, x)})
      shape.triangles.push_back(outward ? std::array<Vec3, 3>{a, b, dent}
                                        : std::array<Vec3, 3>{b, a, dent});
  }
  return shape;
}

const Case cases[] = {{"Balls", {ball}, {100}, 0.52},
                      {"BallsOfTwoSizes", {ball, SphereShape{5e-3}}, {50, 200}, 0.55},
                      {"Ellipsoids", {EllipsoidShape{{16e-3, 10e-3, 8e-3}}}, {60}, 0.55},
                      {"Superquadrics", {rounded_cube}, {40}, 0.5},
                      {"Tablets", {CylinderShape{12e-3, 6e-3, 1e-3}}, {60}, 0.55},
                      {"SharpCylinders", {CylinderShape{8e-3, 12e-3, 0}}, {40}, 0.48, 0.45},
                      {"RoundedPolyhedra", {cut_cube(1e-3)}, {50}, 0.5},
                      {"SharpPolyhedra", {cut_cube(0)}, {50}, 0.5, 0.45},
                      {"StlShapes", {dented(0)}, {60}, 0.35, 0.35},
                      {"SmoothStlShapes", {dented(0.2)}, {30}, 0.4, 0.4},
                      {"BallsAndTablets", {ball, CylinderShape{12e-3, 6e-3, 1e-3}}, {30, 30}, 0.5}};

// Points on the surface of a body, in its own frame, and the test whether a point lies inside: by the shape's own formula,
// which the packing does not use.
class Surface {
 public:
  explicit Surface(const ParticleShape& shape) : star_(star_surface(shape)) {
    for (int i = 0; i <= steps; ++i)
      for (int k = 0; k < 2 * steps; ++k) {
        const double polar = pi * i / steps, azimuth = pi * k / steps;
        points.push_back(star_->point({std::sin(polar) * std::cos(azimuth),
                                       std::sin(polar) * std::sin(azimuth), std::cos(polar)}));
      }
  }
  bool holds(const Vec3& p) const { return p.norm() < star_->radius(p.normalized()); }
  double reach() const { return star_->half_size().norm(); }
  double volume() const { return star_->volume(); }

  std::vector<Vec3> points;

 private:
  static constexpr int steps = 16;
  std::unique_ptr<StarSurface> star_;
};

std::vector<Surface> surfaces_of(const Scene& scene) {
  std::vector<Surface> surfaces;
  for (const ParticleSpec& particle : scene.particles) surfaces.emplace_back(particle.shape);
  return surfaces;
}

bool in_die(const PackingSpec& packing, const Vec3& p) {
  const ContainerSpec& die = packing.container;
  if (p.z() < die.corner.z() || p.z() > packing.top) return false;
  const Vec3 from = p - die.corner;
  if (die.kind == ContainerSpec::Kind::cylinder) return from.head<2>().norm() <= die.diameter / 2;
  return from.x() >= 0 && from.x() <= die.width && from.y() >= 0 && from.y() <= die.depth;
}

// No point of one surface lies in another particle or outside of the die: every pair is looked at.
void expect_apart(const Scene& scene) {
  const std::vector<BodySpec> bodies = place_bodies(scene);
  const std::vector<Surface> surfaces = surfaces_of(scene);
  const auto surface = [&](const BodySpec& b) -> const Surface& {
    return surfaces[static_cast<std::size_t>(b.particle)];
  };
  int outside = 0, overlaps = 0;
  for (const BodySpec& a : bodies) {
    std::vector<Vec3> points;
    for (const Vec3& own : surface(a).points) points.push_back(a.position + a.rotation * own);
    for (const Vec3& p : points) outside += in_die(scene.packings[0], p) ? 0 : 1;
    for (const BodySpec& b : bodies)
      if (&a != &b && (a.position - b.position).norm() < surface(a).reach() + surface(b).reach())
        for (const Vec3& p : points)
          overlaps += surface(b).holds(b.rotation.conjugate() * (p - b.position)) ? 1 : 0;
  }
  EXPECT_EQ(outside, 0);
  EXPECT_EQ(overlaps, 0);
}

double density_in(const Scene& scene) {
  const PackingSpec& packing = scene.packings[0];
  const ContainerSpec& die = packing.container;
  const double area = die.kind == ContainerSpec::Kind::cylinder
                          ? pi / 4 * die.diameter * die.diameter
                          : die.width * die.depth;
  std::vector<double> volumes;
  for (const ParticleSpec& particle : scene.particles)
    volumes.push_back(star_surface(particle.shape)->volume());
  double volume = 0;
  for (const BodySpec& body : place_bodies(scene))
    volume += volumes[static_cast<std::size_t>(body.particle)];
  return volume / (area * (packing.top - die.corner.z()));
}

class RandomPackingsInSpace : public testing::TestWithParam<Case> {};

TEST_P(RandomPackingsInSpace, AreAsDenseAsWantedInABox) {
  PackingSpec packing = in_box(45e-3, GetParam().counts);
  packing.container.corner = {1e-3, -2e-3, 3e-3};
  packing.density = GetParam().density;
  Scene scene = scene_of(GetParam().shapes, packing);
  EXPECT_NEAR(filled(scene).reached.density, GetParam().density, 1e-9);
  EXPECT_NEAR(density_in(scene), GetParam().density, 1e-9);
  expect_apart(scene);
}

TEST_P(RandomPackingsInSpace, AreAsDenseAsWantedInARoundDie) {
  PackingSpec packing = in_cylinder(50e-3, GetParam().counts);
  packing.density = std::min(0.45, GetParam().density);
  Scene scene = scene_of(GetParam().shapes, packing);
  filled(scene);
  EXPECT_NEAR(density_in(scene), *packing.density, 1e-9);
  expect_apart(scene);
}

// Three and more touches hold a particle; those of the frictionless are within a thousandth of a diameter.
TEST_P(RandomPackingsInSpace, TouchWhenPressedUntilNothingMoves) {
  PackingSpec packing = in_box(45e-3, GetParam().counts);
  packing.dense = PackingSpec::Dense::touching;
  Scene scene = scene_of(GetParam().shapes, packing);
  const PackingReached reached = filled(scene).reached;
  EXPECT_LT(reached.mean_gap, 0.02);
  EXPECT_GT(reached.min_gap, 0);
  EXPECT_GT(reached.density, GetParam().at_rest);
  EXPECT_NEAR(reached.density, density_in(scene), 1e-9);
  expect_apart(scene);
}

const auto name_of_case = [](const auto& info) { return info.param.name; };
INSTANTIATE_TEST_SUITE_P(Shapes, RandomPackingsInSpace, testing::ValuesIn(cases), name_of_case);

PackingSpec touching(double edge, int count) {
  PackingSpec packing = in_box(edge, {count});
  packing.dense = PackingSpec::Dense::touching;
  return packing;
}

// Monodisperse balls come to rest at 0.64 (Scott & Kilgour 1969). Walls keep them emptier by about 0.2 to 0.4 diameters over
// the width: the middle of the packing is looked at, by points that lie in a ball or not.
TEST(RandomPackingInSpace, BallsJamWhereKnown) {
  PackingSpec packing = in_box(90e-3, {800});
  packing.dense = PackingSpec::Dense::densest;
  Scene scene = scene_of({ball}, packing);
  const double height = filled(scene).top;
  const std::vector<BodySpec> bodies = place_bodies(scene);
  portable::Random random(4);
  int inside = 0;
  constexpr int points = 20'000;
  const Vec3 low(15e-3, 15e-3, 15e-3), high(75e-3, 75e-3, height - 15e-3);
  for (int i = 0; i < points; ++i) {
    const Vec3 p = low + (high - low)
                             .cwiseProduct(Vec3(random.between(0, 1), random.between(0, 1),
                                                random.between(0, 1)));
    inside += std::ranges::any_of(
        bodies, [&](const BodySpec& b) { return (b.position - p).norm() < 5e-3; });
  }
  EXPECT_NEAR(inside / static_cast<double>(points), 0.64, 0.02);
}

TEST(RandomPackingInSpace, FollowsTheSeedAlone) {
  const auto packed = [](std::uint64_t seed) {
    PackingSpec packing = in_box(45e-3, {20, 20});
    packing.density = 0.5;
    Scene scene = scene_of({ball, EllipsoidShape{{16e-3, 10e-3, 8e-3}}}, packing, seed);
    return filled(scene).placed;
  };
  const std::vector<BodySpec> a = packed(7), b = packed(7), c = packed(8);
  bool differs = false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].position, b[i].position);
    EXPECT_EQ(a[i].rotation.coeffs(), b[i].rotation.coeffs());
    differs |= a[i].position != c[i].position;
  }
  EXPECT_TRUE(differs);
}

TEST(RandomPackingInSpace, RefusesADensityThatIsNotReachedWithTheOneThatIs) {
  PackingSpec packing = in_box(45e-3, {100});
  packing.density = 0.72;
  Scene scene = scene_of({ball}, packing);
  try {
    filled(scene);
    FAIL() << "0.72 is beyond random close packing";
  } catch (const SceneError& error) {
    ASSERT_EQ(error.errors().size(), 1u);
    const SceneProblem& problem = error.errors()[0];
    EXPECT_EQ(problem.line, 8);
    EXPECT_EQ(problem.key, "packing[0].density");
    EXPECT_THAT(problem.message, HasSubstr("a relative density of 0.7200 cannot be reached"));
    EXPECT_THAT(problem.message,
                testing::ContainsRegex("ended at 0\\.5[0-9]+, allowed: at most 0\\.5"));
  }
}

TEST(RandomPackingInSpace, RefusesParticlesThatDoNotFit) {
  Scene scene = scene_of({ball}, touching(9e-3, 5));
  try {
    filled(scene);
    FAIL();
  } catch (const SceneError& error) {
    EXPECT_THAT(error.what(), HasSubstr("'a' is 0.01 m wide and does not fit into the die"));
  }
}

// Shares of the volume become shares of the number by the volumes of single particles: 1 : 8 of balls of 10 and 5 mm.
TEST(RandomPackingInSpace, VolumeFractionsAreOfTheVolume) {
  PackingSpec packing = in_box(60e-3, {0, 0});
  packing.density = 0.5;
  packing.count = 180;
  for (MixtureClass& mixed : packing.classes) {
    mixed.number.reset();
    mixed.content_fraction = 0.5;
  }
  Scene scene = scene_of({ball, SphereShape{5e-3}}, packing);
  const std::vector<BodySpec> bodies = filled(scene).placed;
  EXPECT_EQ(std::ranges::count(bodies, 0, &BodySpec::particle), 20);
  EXPECT_EQ(std::ranges::count(bodies, 1, &BodySpec::particle), 160);
}

// By number: the sizes of a law have its mean volume, so that density and count leave the height that follows from it.
TEST(RandomPackingInSpace, SizesOfALawHaveItsMeanVolume) {
  PackingSpec packing = in_box(60e-3, {0});
  packing.classes[0].number.reset();
  packing.density = 0.5;
  packing.count = 160;
  SizeLaw& law = packing.classes[0].size;
  law.kind = SizeLaw::Kind::uniform;
  law.minimum = 6e-3;
  law.maximum = 12e-3;
  Scene scene = scene_of({ball}, packing);
  filled(scene);
  EXPECT_EQ(scene.particles.size(), 1u + 8u);
  double volume = 0;
  for (const BodySpec& body : place_bodies(scene)) {
    const auto& sized = scene.particles[static_cast<std::size_t>(body.particle)];
    EXPECT_EQ(sized.class_of, 0);
    volume += pi / 6 * std::pow(std::get<SphereShape>(sized.shape).diameter, 3);
  }
  // Mean of d^3 over 6 to 12 mm: (12^4 - 6^4)/(4 * 6) mm^3.
  EXPECT_NEAR(volume / 160, pi / 6 * 810e-9, 1e-5 * pi / 6 * 810e-9);
}

// Count from density and height.
TEST(RandomPackingInSpace, CountFollowsFromDensityAndHeight) {
  PackingSpec packing = in_box(50e-3, {0});
  packing.classes[0].number.reset();
  packing.density = 0.5;
  packing.height = 50e-3;
  Scene scene = scene_of({ball}, packing);
  const PackingSpec done = filled(scene);
  EXPECT_EQ(done.placed.size(), std::round(0.5 * 125e-6 / (pi / 6 * 1e-6)));
  EXPECT_NEAR(done.top, 50e-3, 1e-12);
}

}  // namespace
}  // namespace pulvis::space
