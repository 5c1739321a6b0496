// True surfaces: radii, normals, volumes, centres; STL files.
#include "scenes/meshes/hexahedra/star_surface.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cctype>
#include <cstring>
#include <limits>
#include <numbers>
#include <sstream>

#include "scenes/meshes/hexahedra/directions.hpp"
#include "scenes/meshes/hexahedra/rounded_polyhedron.hpp"
#include "scenes/meshes/hexahedra/stl.hpp"
#include "tests/scenes/meshes/hexahedra/shape_cases.hpp"

namespace pulvis::space {
namespace {

using std::numbers::pi;
using testing::HasSubstr;

// A bumpy ball of n x 2n quads, split: star-shaped about its middle.
std::vector<Triangle> bumpy_ball(int n, const Vec3& middle) {
  const auto at = [&](int i, int j) {
    const double polar = pi * i / n, round = pi * (j % (2 * n)) / n;
    const double r = i == 0 || i == n ? 1 : 1 + 0.1 * std::sin(polar) * std::cos(3 * round);
    const double across = i == 0 || i == n ? 0 : std::sin(polar);
    return Vec3(middle +
                r * Vec3(across * std::cos(round), across * std::sin(round), std::cos(polar)));
  };
  std::vector<Triangle> triangles;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < 2 * n; ++j) {
      if (i < n - 1) triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      if (i > 0) triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return triangles;
}

std::string as_text(const std::vector<Triangle>& triangles) {
  std::ostringstream text;
  text.precision(17);
  text << "solid ball\n";
  for (const Triangle& t : triangles) {
    text << " facet normal 0 0 0\n  outer loop\n";
    for (const Vec3& p : t) text << "   vertex " << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
    text << "  endloop\n endfacet\n";
  }
  return text.str() + "endsolid ball\n";
}

std::string as_binary(const std::vector<Triangle>& triangles) {
  std::string bytes(80, ' ');
  bytes.replace(0, 5, "solid");  // as some programs write it
  const auto put = [&](const auto& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  put(static_cast<std::uint32_t>(triangles.size()));
  for (const Triangle& t : triangles) {
    for (int i = 0; i < 3; ++i) put(0.0F);
    for (const Vec3& p : t)
      for (int i = 0; i < 3; ++i) put(static_cast<float>(p[i]));
    put(std::uint16_t{0});
  }
  return bytes;
}

std::string problem_of(const std::string& bytes) {
  try {
    stl_triangles(bytes);
  } catch (const BadStl& problem) {
    return problem.what();
  }
  return "";
}

// The sums over 24,576 directions are good to 2e-4 where a rim is sharp and far away.
TEST(StarSurface, HasTheVolumeThatItsRadiiEnclose) {
  for (const ShapeCase& c : shape_cases()) {
    const auto surface = star_surface(c.shape);
    EXPECT_NEAR(volume_about(*surface, 32) / surface->volume(), 1, 3e-4) << c.name;
  }
}

TEST(StarSurface, HasItsCentreOfVolumeAtTheOrigin) {
  for (const ShapeCase& c : shape_cases()) {
    const auto surface = star_surface(c.shape);
    EXPECT_LT(centre_of_volume(*surface, 32).norm(), 1e-4 * surface->half_size().norm()) << c.name;
  }
}

// The normal is across the surface: against differences along it.
TEST(StarSurface, HasNormalsAcrossItself) {
  for (const ShapeCase& c : shape_cases()) {
    const auto surface = star_surface(c.shape);
    for (const Direction& d : directions(3)) {
      const Vec3 normal = surface->normal(d.unit), x = normal.unitOrthogonal();
      EXPECT_NEAR(normal.norm(), 1, 1e-12);
      for (const Vec3& side : {x, Vec3(normal.cross(x))}) {
        const double step = 1e-6;
        const Vec3 along = surface->point((d.unit + step * side).normalized()) -
                           surface->point((d.unit - step * side).normalized());
        EXPECT_LT(std::abs(along.dot(normal)), 1e-4 * along.norm()) << c.name;
      }
    }
  }
}

TEST(StarSurface, OfAnEllipsoidSuperquadricIsTheEllipsoid) {
  const Vec3 size(3, 2, 1);
  const auto a = star_surface(EllipsoidShape{size}),
             b = star_surface(SuperquadricShape{size, 2, 2});
  EXPECT_NEAR(a->volume(), pi, 1e-14);
  EXPECT_NEAR(b->volume(), pi, 1e-12);
  for (const Direction& d : directions(2)) EXPECT_NEAR(a->radius(d.unit), b->radius(d.unit), 1e-14);
}

TEST(StarSurface, OfARoundedBoxHasSteinersVolume) {
  const double w = 0.1, a = 0.8;
  const auto box = star_surface(box_shape({1, 1, 1}, w));
  EXPECT_NEAR(box->volume(),
              a * a * a + 6 * a * a * w + 3 * pi * a * w * w + 4 * pi / 3 * w * w * w, 1e-14);
  EXPECT_NEAR(box->radius(Vec3(1, 1, 1).normalized()), std::sqrt(3.0) * 0.4 + w, 1e-12);
  EXPECT_NEAR(box->radius(Vec3(0, 0, 1)), 0.5, 1e-15);
  EXPECT_LT((centre_of(box_shape({1, 1, 1}, w, {3, -1, 2})) - Vec3(3, -1, 2)).norm(), 1e-14);
}

// A pyramid has its centre at a quarter of its height; rounded, where the rays from there say.
TEST(StarSurface, OfAPolyhedronKnowsItsCentre) {
  PolyhedronShape pyramid{{{1, 1, 0}, {-1, 1, 0}, {-1, -1, 0}, {1, -1, 0}, {0, 0, 2}}, 0};
  EXPECT_LT((centre_of(pyramid) - Vec3(0, 0, 0.5)).norm(), 1e-13);
  pyramid.rounding = 0.2;
  EXPECT_LT(centre_of_volume(*star_surface(pyramid), 32).norm(), 1e-4);
}

TEST(StarSurface, RoundingThatLeavesNothingIsRefused) {
  EXPECT_THROW(star_surface(box_shape({1, 1, 1}, 0.6)), std::invalid_argument);
}

TEST(Stl, BinaryAndTextAreTheSame) {
  const std::vector<Triangle> ball = bumpy_ball(8, {1, 2, 3});
  const std::vector<Triangle> text = stl_triangles(as_text(ball)),
                              binary = stl_triangles(as_binary(ball));
  ASSERT_EQ(text.size(), ball.size());
  ASSERT_EQ(binary.size(), ball.size());
  for (std::size_t t = 0; t < ball.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(text[t][k], ball[t][k]);
      EXPECT_LT((binary[t][k] - ball[t][k]).norm(), 1e-6);
    }
}

TEST(Stl, WhatIsNoClosedSurfaceIsRefused) {
  std::vector<Triangle> ball = bumpy_ball(6, Vec3::Zero());
  std::vector<Triangle> open = ball, inverted = ball, turned = ball, infinite = ball;
  open.pop_back();
  for (Triangle& t : inverted) std::swap(t[0], t[1]);
  std::swap(turned[3][0], turned[3][1]);
  infinite[5][1].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(problem_of(as_text(open)), HasSubstr("open"));
  EXPECT_THAT(problem_of(as_binary(inverted)), HasSubstr("face inwards"));
  EXPECT_THAT(problem_of(as_text(turned)), HasSubstr("have opposite orientation"));
  EXPECT_THAT(problem_of(as_binary(infinite)), HasSubstr("not finite"));
  EXPECT_THAT(problem_of(as_binary(ball).substr(0, 500)), HasSubstr("truncated"));
  EXPECT_THAT(problem_of("solid x\nvertex 1 2\n"), HasSubstr("where a coordinate is expected"));
  EXPECT_THAT(problem_of("solid x\nvertex 1 2 3\n"), HasSubstr("truncated"));
  EXPECT_THAT(problem_of("hello"), HasSubstr("neither"));
  EXPECT_THAT(problem_of("solid x\nendsolid x\n"), HasSubstr("no triangle"));
  EXPECT_EQ(problem_of(as_text(ball)), "");
}

// As other programs write them: in capitals, with a mark of UTF-8, after a blank line, and with any name.
TEST(Stl, TextFilesMayBeginInDifferentWays) {
  const std::string text = as_text(bumpy_ball(4, {1, 2, 3}));
  const auto volume = [](const std::string& bytes) { return volume_of(stl_triangles(bytes)); };
  std::string capitals = text;
  for (char& c : capitals) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  EXPECT_EQ(volume(capitals), volume(text));
  EXPECT_EQ(volume("\xEF\xBB\xBF" + text), volume(text));
  EXPECT_EQ(volume(" \r\n" + text), volume(text));
  EXPECT_EQ(volume("solid my vertex part\n" + text.substr(text.find('\n') + 1)), volume(text));
}

TEST(Stl, ASurfaceThatItsCentreDoesNotSeeIsRefused) {
  EXPECT_FALSE(why_not_star_shaped(bumpy_ball(8, {1, 2, 3})));
  std::vector<Triangle> folded = bumpy_ball(8, {1, 2, 3});
  for (Triangle& t : folded)  // a deep hollow from above
    for (Vec3& p : t)
      if (p.z() > 3.9) p.z() = 2.2;
  EXPECT_TRUE(why_not_star_shaped(folded));
  EXPECT_THROW(star_surface(StlShape{"", "m", {}, 0, folded}), std::invalid_argument);
}

TEST(StarSurface, OfAFileIsScaledToItsDiameterAndSmoothed) {
  const std::vector<Triangle> ball = bumpy_ball(12, {1, 2, 3});
  for (const double smoothing : {0.0, 0.2}) {
    const auto surface = star_surface(StlShape{"", "m", 3.0, smoothing, ball});
    EXPECT_NEAR(surface->volume(), pi / 6 * 27, 1e-12 * 27);
    EXPECT_NEAR(volume_about(*surface, 16), pi / 6 * 27, 2e-3 * 27);
  }
  const auto sharp = star_surface(StlShape{"", "m", 2.0, 0, ball}),
             soft = star_surface(StlShape{"", "m", 2.0, 0.4, ball});
  const auto bump = [](const StarSurface& s) {
    return s.radius(Vec3(1, 0, 0)) - s.radius(Vec3(0.5, std::sqrt(0.75), 0));
  };
  EXPECT_NEAR(bump(*sharp), 0.2, 0.02);
  EXPECT_LT(bump(*soft), 0.9 * bump(*sharp));
  EXPECT_GT(bump(*soft), 0.3 * bump(*sharp));
}

TEST(SpaceMesh, OfAFileHasItsVolume) {
  const Shape shape = shape_of(StlShape{"", "m", 2.0, 0.1, bumpy_ball(10, {1, 2, 3})}, 4, 2);
  EXPECT_NEAR(mesh_volume(shape), 4 * pi / 3, 1e-11);
}

}  // namespace
}  // namespace pulvis::space
