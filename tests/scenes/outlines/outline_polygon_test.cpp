// Polygons inscribed in outlines: closed, on the outline, as close to it as asked.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenes/outlines/outline.hpp"

namespace pulvis {
namespace {

double polygon_area(const std::vector<Vec2>& points) {
  double twice = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec2 &a = points[i], &b = points[(i + 1) % points.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return twice / 2;
}

double shortest_side(const std::vector<Vec2>& points) {
  double minimum = 1e300;
  for (std::size_t i = 0; i < points.size(); ++i)
    minimum = std::min(minimum, (points[i] - points[(i + 1) % points.size()]).norm());
  return minimum;
}

TEST(OutlinePolygon, LeavesTheDiscByAtMostTheDeviation) {
  for (const double deviation : {1e-3, 1e-4, 1e-6, 0.3}) {
    const auto points = outline_polygon(DiscOutline{2.0}, deviation);
    for (std::size_t i = 0; i < points.size(); ++i) {
      EXPECT_NEAR(points[i].norm(), 1, 1e-12);
      const Vec2 middle = (points[i] + points[(i + 1) % points.size()]) / 2;
      EXPECT_GE(middle.norm(), 1 - deviation - 1e-12);
    }
    EXPECT_GT(shortest_side(points), 1e-3 * std::sqrt(deviation));
  }
}

TEST(OutlinePolygon, HasTheAreaOfTheOutlineInTheLimit) {
  const Outline rounded = RoundedRectangleOutline{15, 10, 4},
                stadium = RoundedRectangleOutline{15, 10, 5};
  EXPECT_NEAR(polygon_area(outline_polygon(rounded, 1e-7)), outline_area(rounded), 1e-5);
  EXPECT_NEAR(polygon_area(outline_polygon(stadium, 1e-7)), outline_area(stadium), 1e-5);
  EXPECT_GT(shortest_side(outline_polygon(stadium, 1e-7)), 1e-5);
  EXPECT_EQ(outline_polygon(RectangleOutline{3, 2}, 1e-7).size(), 4u);
  EXPECT_NEAR(polygon_area(outline_polygon(RectangleOutline{3, 2}, 1)), 6, 1e-14);
}

TEST(OutlineArea, IsThatOfTheClosedForm) {
  EXPECT_NEAR(outline_area(EllipseOutline{4, 2}), 2 * std::numbers::pi, 1e-14);
  EXPECT_NEAR(outline_area(SuperellipseOutline{4, 2, 2}), 2 * std::numbers::pi, 1e-14);
  EXPECT_NEAR(outline_area(SuperellipseOutline{4, 2, 1.5}), 8 * 0.6844634, 1e-5);
  const double hexagon = 1.5 * std::numbers::sqrt3;  // of sides 1
  EXPECT_NEAR(outline_area(PolygonOutline{6, 2, {}, 0, false}), hexagon, 1e-13);
  // Six corners give up r^2 (tan 30 - pi/6) each.
  EXPECT_NEAR(outline_area(PolygonOutline{6, 2, {}, 0.3, false}),
              hexagon - 6 * 0.09 * (1 / std::numbers::sqrt3 - std::numbers::pi / 6), 1e-13);
  // A corner that points inwards gains by its rounding what one that points outwards loses.
  const std::vector<Vec2> angle{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
  EXPECT_NEAR(outline_area(PolygonOutline{0, 0, angle, 0.2, false}),
              3 - 4 * 0.04 * (1 - std::numbers::pi / 4), 1e-13);
}

std::vector<Outline> curved() {
  const std::vector<Vec2> clockwise{{0, 0}, {1, 6}, {7, 4}, {5, -1}};
  PointsOutline traced;
  for (int i = 0; i < 24; ++i) {
    const double a = 2 * std::numbers::pi * i / 24,
                 r = 1 + 0.2 * std::cos(3 * a) + 0.1 * std::sin(a);
    traced.points.emplace_back(3 + r * std::cos(a), r * std::sin(a));
  }
  return {EllipseOutline{6, 1},
          SuperellipseOutline{3, 2, 1.5},
          SuperellipseOutline{3, 2, 20},
          PolygonOutline{5, 2, {}, 0.2, false},
          PolygonOutline{0, 0, clockwise, 0.5, true},
          traced,
          FourierOutline{2, 1.5, 0.08, 0.01, 2, 16, 3}};
}

TEST(OutlinePolygon, OfACurvedOutlineIsAsCloseAsAskedAndCentred) {
  for (const Outline& outline : curved()) {
    const double area = outline_area(outline);
    const auto fine = outline_polygon(outline, 1e-7), coarse = outline_polygon(outline, 1e-2);
    EXPECT_NEAR(polygon_area(fine) / area, 1, 1e-5);
    EXPECT_LT(coarse.size(), fine.size() / 10);
    Vec2 moment = Vec2::Zero();
    for (std::size_t i = 0; i < fine.size(); ++i) {
      const Vec2 &a = fine[i], &b = fine[(i + 1) % fine.size()];
      moment += (a.x() * b.y() - a.y() * b.x()) / 6 * (a + b);
    }
    EXPECT_LT(moment.norm() / area, 1e-5);
    // Every corner of the fine polygon lies within the deviation of the coarse one.
    for (const Vec2& p : fine) {
      double minimum = 1;
      for (std::size_t i = 0; i < coarse.size(); ++i) {
        const Vec2 &a = coarse[i], along = coarse[(i + 1) % coarse.size()] - a;
        const double share = std::clamp((p - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
        minimum = std::min(minimum, (p - a - share * along).norm());
      }
      EXPECT_LT(minimum, 1e-2);
    }
  }
}

}  // namespace
}  // namespace pulvis
