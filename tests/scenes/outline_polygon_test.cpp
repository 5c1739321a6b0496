// Polygons inscribed in outlines: closed, on the outline, as close to it as asked.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scenes/outline.hpp"

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
  double least = 1e300;
  for (std::size_t i = 0; i < points.size(); ++i)
    least = std::min(least, (points[i] - points[(i + 1) % points.size()]).norm());
  return least;
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

}  // namespace
}  // namespace pulvis
