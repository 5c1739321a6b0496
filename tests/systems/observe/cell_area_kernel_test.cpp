// Areas of outlines in the cells of a grid: against closed forms, and against clipping by half-planes
// (Sutherland & Hodgman 1974), which has nothing in common with the integral that is tested.
#include "systems/observe/cell_area_kernel.hpp"

#include <gtest/gtest.h>

#include <array>
#include <numbers>
#include <numeric>
#include <vector>

#include "tests/helpers/random_values.hpp"

namespace pulvis::kernels {
namespace {

using Corner = std::array<double, 2>;
using Polygon = std::vector<Corner>;

std::vector<double> areas_of(const Polygon& polygon, int columns, int rows, double weight = 1) {
  CellAreas cells(columns, rows);
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Corner &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    cells.add_edge(a[0], a[1], b[0], b[1], weight);
  }
  return cells.areas();
}

double sum(const std::vector<double>& areas) {
  return std::accumulate(areas.begin(), areas.end(), 0.0);
}

double area_of(const Polygon& polygon) {
  double twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Corner &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    twice += a[0] * b[1] - a[1] * b[0];
  }
  return twice / 2;
}

// The part with sign * coordinate[axis] >= sign * bound.
Polygon clipped(const Polygon& polygon, std::size_t axis, double sign, double bound) {
  Polygon kept;
  const auto inside = [&](const Corner& p) { return sign * (p[axis] - bound) >= 0; };
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Corner &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    if (inside(a)) kept.push_back(a);
    if (inside(a) == inside(b)) continue;
    const double share = (bound - a[axis]) / (b[axis] - a[axis]);
    kept.push_back({a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])});
  }
  return kept;
}

Polygon circle(double x, double y, double radius, int corners) {
  Polygon polygon;
  for (int k = 0; k < corners; ++k) {
    const double angle = 2 * std::numbers::pi * k / corners;
    polygon.push_back({x + radius * std::cos(angle), y + radius * std::sin(angle)});
  }
  return polygon;
}

// Star-shaped, not convex, partly outside of the grid.
Polygon star(Random& random) {
  Polygon polygon;
  const double x = random.in(-1, 6), y = random.in(-1, 5);
  for (int k = 0; k < 24; ++k) {
    const double angle = 2 * std::numbers::pi * (k + random.in(0, 0.9)) / 24;
    const double radius = random.in(0.3, 2.5);
    polygon.push_back({x + radius * std::cos(angle), y + radius * std::sin(angle)});
  }
  return polygon;
}

TEST(CellAreas, AreThoseOfClippingByEveryCell) {
  Random random(7);
  for (int trial = 0; trial < 200; ++trial) {
    const Polygon polygon = star(random);
    const auto areas = areas_of(polygon, 5, 4);
    for (std::size_t j = 0; j < 4; ++j)
      for (std::size_t i = 0; i < 5; ++i) {
        const auto x = static_cast<double>(i), y = static_cast<double>(j);
        const Polygon in_cell = clipped(
            clipped(clipped(clipped(polygon, 0, 1, x), 0, -1, x + 1), 1, 1, y), 1, -1, y + 1);
        ASSERT_NEAR(areas[j * 5 + i], area_of(in_cell), 1e-13) << trial << " " << i << " " << j;
      }
  }
}

// A quarter of a disc, and the segment that a line at h from its centre cuts off.
TEST(CellAreas, OfADiscAcrossCells) {
  const double r = 0.8, h = 0.3;
  const auto areas = areas_of(circle(1, 1 + h, r, 100000), 2, 2);
  const double below = r * r * std::acos(h / r) - h * std::sqrt(r * r - h * h);
  const double above = std::numbers::pi * r * r - below;
  EXPECT_NEAR(areas[0], below / 2, 1e-9);
  EXPECT_NEAR(areas[1], below / 2, 1e-9);
  // The top of the disc reaches out of the grid by r + h - 1.
  const double d = 1 - h, out = r * r * std::acos(d / r) - d * std::sqrt(r * r - d * d);
  EXPECT_NEAR(areas[2] + areas[3], above - out, 1e-9);
}

TEST(CellAreas, OfAnOutlineInsideTheGridAddUpToItsArea) {
  const Polygon polygon = circle(2.7, 1.9, 1.45, 37);
  EXPECT_NEAR(sum(areas_of(polygon, 5, 4)), area_of(polygon), 1e-14);
}

TEST(CellAreas, OfAnOutlineAroundTheGridAreThoseOfTheCells) {
  for (const double area : areas_of({{-9, -1}, {30, -8}, {20, 9}, {-5, 40}}, 3, 3))
    EXPECT_NEAR(area, 1, 1e-13);
}

TEST(CellAreas, AreZeroForAnOutlineBesideTheGrid) {
  for (const Corner at : {Corner{-3, 1}, Corner{8, 1}, Corner{1, -3}, Corner{1, 8}})
    for (const double area : areas_of(circle(at[0], at[1], 1.9, 50), 4, 3))
      EXPECT_NEAR(area, 0, 1e-14);
}

// Edges on the lines of the grid belong to one side only.
TEST(CellAreas, OfAnOutlineOnTheLinesOfTheGrid) {
  const auto areas = areas_of({{1, 1}, {3, 1}, {3, 2}, {1, 2}}, 4, 3);
  const std::vector<double> expected{0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 0};
  EXPECT_EQ(areas, expected);
}

TEST(CellAreas, LoseWhatAHoleTakes) {
  CellAreas cells(3, 3);
  const Polygon outer = circle(1.5, 1.5, 1.2, 64), inner = circle(1.4, 1.6, 0.5, 32);
  for (const auto& [polygon, weight] : {std::pair{&outer, 1.0}, std::pair{&inner, -1.0}})
    for (std::size_t i = 0; i < polygon->size(); ++i) {
      const Corner &a = (*polygon)[i], &b = (*polygon)[(i + 1) % polygon->size()];
      cells.add_edge(a[0], a[1], b[0], b[1], weight);
    }
  EXPECT_NEAR(sum(cells.areas()), area_of(outer) - area_of(inner), 1e-14);
}

// Nearly level edges: the share of the height is a quotient of two small numbers.
TEST(CellAreas, OfNearlyLevelEdges) {
  for (const double tilt : {1e-3, 1e-9, 1e-15}) {
    const auto areas =
        areas_of({{0.25, 0.5}, {0.75, 0.5}, {0.75, 1 + tilt}, {0.25, 1 - tilt}}, 1, 2);
    EXPECT_NEAR(areas[0], 0.25 - tilt * 0.5 * 0.25, 1e-16 + 1e-15);
    EXPECT_NEAR(areas[1], tilt * 0.5 * 0.25, 1e-16);
  }
}

}  // namespace
}  // namespace pulvis::kernels
