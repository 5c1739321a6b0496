// Rigid bodies hold the true surface of their shapes, and distances between them are those of closed forms.
#include <gtest/gtest.h>

#include <numbers>

#include "scenes/meshes/hexahedra/star_surface.hpp"
#include "scenes/meshes/hexahedra/triangle.hpp"
#include "scenes/outlines/portable.hpp"
#include "scenes/packing/solids/rigid_contact.hpp"

namespace pulvis::space {
namespace {

Vec3 random_direction(portable::Random& random) {
  for (;;) {
    const Vec3 p(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1));
    if (p.norm() > 0.1 && p.norm() < 1) return p.normalized();
  }
}

PolyhedronShape wedge() {
  return {.corners = {{0, 0, 0}, {2, 0, 0}, {0, 1, 0}, {2, 1, 0}, {0, 0, 1}, {2, 0, 1}},
          .rounding = 0.1};
}

class RigidShapes : public testing::TestWithParam<ParticleShape> {};

// h(n) = max p.n over the surface: no point of it lies beyond, and where n is the surface's normal there h is reached.
TEST_P(RigidShapes, SupportIsThatOfTheTrueSurface) {
  const RigidShape rigid = rigid_shape(GetParam(), 1);
  const auto surface = star_surface(GetParam());
  portable::Random random(2);
  for (int i = 0; i < 3000; ++i) {
    const Vec3 d = random_direction(random), n = random_direction(random), p = surface->point(d);
    const V3 along = vector_of(n), normal = vector_of(surface->normal(d));
    EXPECT_LE(p.dot(n), dot(rigid.support(along), along) + 1e-12);
    EXPECT_NEAR(dot(vector_of(p), normal), dot(rigid.support(normal), normal), 1e-9);
    EXPECT_LE(p.norm(), rigid.reach + 1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, RigidShapes,
                         testing::Values(ParticleShape(SphereShape{1.5}),
                                         ParticleShape(EllipsoidShape{{3, 1, 0.5}}),
                                         ParticleShape(SuperquadricShape{{2, 1, 1.5}, 4, 7}),
                                         ParticleShape(SuperquadricShape{{2, 1, 1.5}, 2, 3}),
                                         ParticleShape(CylinderShape{2, 0.8, 0.15}),
                                         ParticleShape(wedge())));

// An octahedron whose edges are smoothed: of the points of its surface none lies outside, some do without the ball about
// the hull's points, and its radius is no larger than it must be.
TEST(RigidBodies, OfASmoothedStlShapeHoldItsSurfaceTightly) {
  StlShape octahedron;
  octahedron.diameter = 2.0;
  octahedron.smoothing = 0.2;
  for (int octant = 0; octant < 8; ++octant) {
    const Vec3 sign(octant & 1 ? -1 : 1, octant & 2 ? -1 : 1, octant & 4 ? -1 : 1);
    const Vec3 x(sign.x(), 0, 0), y(0, sign.y(), 0), z(0, 0, sign.z());
    octahedron.triangles.push_back(sign.prod() > 0 ? Triangle{x, y, z} : Triangle{y, x, z});
  }
  const RigidShape rigid = rigid_shape(octahedron, 1);
  RigidShape hull = rigid;
  hull.radius = 0;
  const auto surface = star_surface(octahedron);
  portable::Random random(3);
  double outside = 0, outside_hull = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Vec3 d = random_direction(random), p = surface->point(d), n = surface->normal(d);
    const V3 along = vector_of(n);
    outside = std::max(outside, p.dot(n) - dot(rigid.support(along), along));
    outside_hull = std::max(outside_hull, p.dot(n) - dot(hull.support(along), along));
  }
  EXPECT_LE(outside, 0);
  EXPECT_GT(outside_hull, 0.5 * rigid.radius);
  EXPECT_GT(rigid.radius, 0);
  EXPECT_LT(rigid.radius, 0.01);
}

// A ball beside an ellipsoid in any position: the distance by points of the ellipsoid's surface, which it is at most, and
// at least less what the points leave between them (their spacing squared over a diameter of curvature).
TEST(RigidPairs, DistanceOfABallFromAnEllipsoidIsThatOfItsSurface) {
  const ParticleShape ellipsoid = EllipsoidShape{{3, 2, 1}};
  const RigidShape a = rigid_shape(ellipsoid, 1), b = rigid_shape(SphereShape{1}, 1);
  const auto surface = star_surface(ellipsoid);
  portable::Random random(5);
  std::vector<Vec3> points;
  for (int i = 0; i < 100'000; ++i) points.push_back(surface->point(random_direction(random)));
  for (int i = 0; i < 30; ++i) {
    const Vec3 d = random_direction(random), centre = surface->point(d) + 0.8 * d;
    double nearest = 1e9;
    for (const Vec3& p : points) nearest = std::min(nearest, (p - centre).norm() - 0.5);
    const RigidPose at_a, at_b{vector_of(centre), {}};
    V3 normal{0, 0, 1};
    const RigidPair pair(a, at_a, b, at_b);
    const auto touch = pair.touch(10, normal);
    ASSERT_TRUE(touch);
    EXPECT_LE(touch->gap, nearest + 1e-9);
    const double distance = pair.distance(touch->normal);
    EXPECT_LE(distance, nearest + 1e-9);
    EXPECT_GE(distance, nearest - 2e-3);
  }
}

// Two unit cubes that overlap by a corner and a face: the least way out is the overlap of the faces.
TEST(RigidPairs, DepthOfCubesIsThatOfTheirFaces) {
  PolyhedronShape cube;
  for (int i = 0; i < 8; ++i) cube.corners.emplace_back(i & 1, (i >> 1) & 1, i >> 2);
  const RigidShape shape = rigid_shape(cube, 1);
  for (const V3& at : {V3{0.95, 0.2, -0.1}, V3{-0.3, 0.9, 0.1}, V3{0.1, -0.2, 0.98}}) {
    const RigidPose a, b{at, {}};
    V3 normal{0, 0, 1};
    const RigidPair pair(shape, a, shape, b);
    const auto touch = pair.touch(0, normal, 1e-12);
    ASSERT_TRUE(touch);
    const double most = std::max({std::abs(at.x), std::abs(at.y), std::abs(at.z)});
    EXPECT_NEAR(pair.distance(touch->normal), most - 1, 1e-9);
  }
}

}  // namespace
}  // namespace pulvis::space
