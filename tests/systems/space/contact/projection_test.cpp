// Closest points on smooth surfaces of particles, against a search of the whole surface.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "systems/space/contact/projection.hpp"
#include "tests/systems/space/contact/touching_bodies.hpp"

namespace pulvis::space {
namespace {

constexpr double ball_diameter = 10e-3;

// A ball whose nodes are displaced at random, and its Bezier points.
struct Surface : TouchingBodies {
  Surface()
      : TouchingBodies({space::make_shape(sphere_of(ball_diameter))},
                       {body_at(Vec3::Zero()), body_at(Vec3(1, 0, 0))}) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> noise(-1e-4, 1e-4);
    move(0, [&](const Vec3& x) {
      return Vec3(x + Vec3(noise(random), noise(random), noise(random)));
    });
    run<contact_surface>("contact_surface");
  }
  const double* first() { return world.column<SurfacePosition>().values(); }
  Vec3 at(int face, double u, double v) {
    const PatchNumbers numbers{first(), entry(shape().faces, face).number.data()};
    const auto bu = kernels::bernstein(u), bv = kernels::bernstein(v);
    Vec3 x = Vec3::Zero();
    for (int p = 0; p < 16; ++p)
      for (int k = 0; k < 3; ++k) x[k] += entry(bu, p % 4) * entry(bv, p / 4) * numbers(k, p);
    return x;
  }
  int faces() const { return static_cast<int>(shape().faces.size()); }

  // Least distance, by ever finer grids around the best point of every face that may have it.
  double distance(const Vec3& p) {
    double least = std::numeric_limits<double>::max();
    for (int f = 0; f < faces(); ++f) {
      double u = 0.5, v = 0.5, reach = 0.5, of_face = (at(f, u, v) - p).norm();
      if (of_face > least + 3e-3) continue;  // no point of a face is farther from its middle
      for (int zoom = 0; zoom < 24; ++zoom) {
        const double from_u = u, from_v = v;
        for (int i = -4; i <= 4; ++i)
          for (int j = -4; j <= 4; ++j) {
            const double a = std::clamp(from_u + reach * i / 4, 0.0, 1.0),
                         b = std::clamp(from_v + reach * j / 4, 0.0, 1.0);
            const double d = (at(f, a, b) - p).norm();
            if (d < of_face) of_face = d, u = a, v = b;
          }
        reach *= 0.5;
      }
      least = std::min(least, of_face);
    }
    return least;
  }
  int nearest_middle(const Vec3& p) {
    int nearest = 0;
    for (int f = 1; f < faces(); ++f)
      if ((at(f, 0.5, 0.5) - p).norm() < (at(nearest, 0.5, 0.5) - p).norm()) nearest = f;
    return nearest;
  }
  Projection project(const std::array<Vec3, 8>& points, const std::array<int, 8>& start) {
    const VectorLanes at{Lane::from([&](int l) { return entry(points, l).x(); }),
                         Lane::from([&](int l) { return entry(points, l).y(); }),
                         Lane::from([&](int l) { return entry(points, l).z(); })};
    Projection p(shape(), first(), at, {start, Lane(0.5), Lane(0.5)});
    p.find();
    return p;
  }
  // Whether the closest points are found of points near the surface: in `direction`, which may scatter. A dented surface
  // can have another stationary point that is no farther than `second` of the least distance.
  void expect_found(std::mt19937_64& random, const std::function<Vec3()>& direction,
                    double second = 0) {
    std::uniform_real_distribution<double> height(-0.3e-3, 0.5e-3);
    std::array<Vec3, 8> points;
    std::array<int, 8> start;
    for (std::size_t l = 0; l < 8; ++l) {
      points[l] = (ball_diameter / 2 + height(random)) * direction();
      start[l] = nearest_middle(points[l]);
    }
    const Projection p = project(points, start);
    EXPECT_EQ(p.unconverged(), 0U);
    const SurfaceGap nearest = p.surface_gap();
    for (int l = 0; l < 8; ++l) {
      const double expected = distance(entry(points, l));
      const double exact = 1e-9 * ball_diameter;
      const Vec3 found = at(entry(p.face, l), p.u[l], p.v[l]), off = entry(points, l) - found;
      EXPECT_NEAR(off.norm(), expected, exact + second * expected);
      EXPECT_NEAR(std::abs(nearest.gap[l]), off.norm(), exact);  // it stands on the normal
      EXPECT_EQ(nearest.gap[l] > 0, entry(points, l).norm() < found.norm());
    }
  }
};

TEST(SpaceProjection, FindsTheClosestPointOfPointsAllOverTheSurface) {
  Surface surface;
  std::mt19937_64 random(2);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 25; ++i)
    surface.expect_found(
        random, [&] { return Vec3(normal(random), normal(random), normal(random)).normalized(); });
}

// About the corners of the cube, where three faces meet.
TEST(SpaceProjection, FindsTheClosestPointAboutNodesWhereThreeFacesMeet) {
  Surface surface;
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> noise(-0.15, 0.15);
  std::bernoulli_distribution sign;
  for (int i = 0; i < 25; ++i)
    surface.expect_found(
        random,
        [&] {
          const auto axis = [&] { return (sign(random) ? 1 : -1) + noise(random); };
          return Vec3(axis(), axis(), axis()).normalized();
        },
        1e-3);
}

// Another search begins at the nearest of its spots, which no corner or middle of a face beats.
TEST(SpaceProjection, BeginsAnewAtTheNearestOfAFewSpots) {
  Surface surface;
  std::mt19937_64 random(4);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 50; ++i) {
    const Vec3 p = 6e-3 * Vec3(normal(random), normal(random), normal(random)).normalized();
    const SurfaceSpot spot = nearest_spot(surface.shape(), surface.first(), {p.x(), p.y(), p.z()});
    const double distance = (surface.at(spot.face, spot.u, spot.v) - p).norm();
    for (int f = 0; f < surface.faces(); ++f)
      for (const auto& [u, v] :
           {std::pair{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}, {1.0, 1.0}, {0.5, 0.5}})
        EXPECT_LE(distance, (surface.at(f, u, v) - p).norm());
  }
}

// From two faces away it walks there, over sides and corners.
TEST(SpaceProjection, WalksOverSides) {
  Surface surface;
  int walked = 0;
  for (int f = 0; f < surface.faces(); ++f) {
    const int next = entry(entry(surface.shape().faces, f).neighbour, 0).face;
    const int far = entry(entry(surface.shape().faces, next).neighbour, 1).face;
    std::array<Vec3, 8> points;
    points.fill(1.02 * surface.at(f, 0.4, 0.6));
    std::array<int, 8> start;
    start.fill(f);
    start[3] = next;
    start[6] = far;
    const Projection p = surface.project(points, start);
    EXPECT_EQ(p.unconverged(), 0U);
    const SurfaceGap nearest = p.surface_gap();
    for (const int l : {3, 6}) {
      EXPECT_EQ(entry(p.face, l), p.face[0]);
      EXPECT_NEAR(nearest.gap[l], nearest.gap[0], 1e-10 * ball_diameter);
      ++walked;
    }
  }
  EXPECT_GT(walked, 100);
}

}  // namespace
}  // namespace pulvis::space
