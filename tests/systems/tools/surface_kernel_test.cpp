// Signed distance to polyline tools: against brute force, as a gradient, over corners, and the search for
// near pieces.
#include "systems/tools/surface_kernel.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "scenes/tools/surface.hpp"
#include "systems/contact/surface_search.hpp"

namespace pulvis {
namespace {

using Points = std::vector<Vec2>;

constexpr double everywhere = std::numeric_limits<double>::infinity();

// Ridges and valleys, gentle and sharp, an overhang, ends that are not level, a point that turns nothing.
const Points wild{{0, 0},    {1, 0},     {2, 1.5}, {2.5, -0.5}, {3, -0.5},
                  {4, -0.5}, {3.6, 1.2}, {5, 1},   {5.5, 2},    {6.5, 2.2}};

kernels::SurfacePoint<double> nearest(const ToolSurface& surface, const Vec2& at) {
  return kernels::nearest_on_surface(surface, 0, static_cast<int>(surface.pieces.size()) - 1,
                                     at.x(), at.y(), everywhere);
}

// The chain with its ends prolonged far beyond where anything is asked.
Points prolonged(const Points& points) {
  Points all{points[0] - 100 * (points[1] - points[0]).normalized()};
  for (const Vec2& p : points) all.push_back(p);
  all.push_back(points.back() + 100 * (points.back() - points[points.size() - 2]).normalized());
  return all;
}

// Left of the chain: a ray straight up to the sky crosses it an even number of times.
bool in_powder(const Points& chain, const Vec2& at) {
  bool powder = true;
  for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
    const Vec2 a = chain[i] - at, b = chain[i + 1] - at;
    if ((a.x() > 0) == (b.x() > 0)) continue;
    if (a.y() - a.x() * (b.y() - a.y()) / (b.x() - a.x()) > 0) powder = !powder;
  }
  return powder;
}

double brute_force(const Points& points, const Vec2& at) {
  const Points chain = prolonged(points);
  double minimum = everywhere;
  for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
    const Vec2 way = chain[i + 1] - chain[i];
    const double s = std::clamp((at - chain[i]).dot(way) / way.squaredNorm(), 0.0, 1.0);
    minimum = std::min(minimum, (at - chain[i] - s * way).norm());
  }
  return in_powder(chain, at) ? minimum : -minimum;
}

class Places {
 public:
  explicit Places(unsigned seed) : random_(seed) {}
  Vec2 next() { return {x_(random_), y_(random_)}; }
  double unit() { return unit_(random_); }

 private:
  std::mt19937_64 random_;
  std::uniform_real_distribution<double> x_{-2, 8}, y_{-3, 4}, unit_{-1, 1};
};

TEST(SurfaceDistance, IsThatOfBruteForce) {
  ASSERT_EQ(fault_of_polyline(wild, 0), "");
  const ToolSurface surface = make_surface(wild, 0);
  Places places(1);
  for (int i = 0; i < 20000; ++i) {
    const Vec2 at = places.next();
    ASSERT_NEAR(nearest(surface, at).distance, brute_force(wild, at), 1e-12) << at.transpose();
  }
}

// A rounded tool is the sharp one, shrunk by the radius and grown again by it: the powder's distance is the
// distance to the shrunk one less the radius. Flat parts and valleys are where they were.
TEST(SurfaceDistance, RoundingShrinksAndGrowsTheTool) {
  const Points points{{0, 0}, {2, 0}, {3, 1}, {4, 0}, {5, 0}, {6, 2}, {8, 2}, {9, 0.5}};
  const double radius = 0.3;
  ASSERT_EQ(fault_of_polyline(points, radius), "");
  const ToolSurface sharp = make_surface(points, 0), rounded = make_surface(points, radius);
  Points shrunk;  // the border of the shrunk tool, densely
  const Points chain = prolonged(points);
  for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
    const Vec2 t = (chain[i + 1] - chain[i]).normalized(), n(-t.y(), t.x());
    const double length = std::min((chain[i + 1] - chain[i]).norm(), 110.0);
    for (double s = 0; s < length; s += 1e-3) {
      const Vec2 at = chain[i] + s * t - radius * n;
      if (std::abs(at.x()) < 15 && nearest(sharp, at).distance <= -radius + 1e-9)
        shrunk.push_back(at);
    }
  }
  Places places(2);
  int asked = 0;
  for (int i = 0; i < 300; ++i) {
    const Vec2 at = places.next();
    const double distance = nearest(rounded, at).distance;
    EXPECT_GE(distance, nearest(sharp, at).distance - 1e-12);
    if (distance < 0) continue;
    double minimum = everywhere;
    for (const Vec2& s : shrunk) minimum = std::min(minimum, (at - s).norm());
    EXPECT_NEAR(distance, minimum - radius, 2e-3) << at.transpose();
    ++asked;
  }
  EXPECT_GT(asked, 100);
  EXPECT_NEAR(nearest(rounded, {1, 0}).distance, 0, 1e-15);
  EXPECT_NEAR(nearest(rounded, {4, 0}).distance, 0, 1e-15);                              // valley
  EXPECT_NEAR(nearest(rounded, {3, 1}).distance, radius * (std::sqrt(2.0) - 1), 1e-12);  // ridge
}

// No distance changes faster than the place: nothing jumps, over corners or between pieces.
TEST(SurfaceDistance, IsContinuousEverywhere) {
  for (const double rounding : {0.0, 0.05}) {
    ASSERT_EQ(fault_of_polyline(wild, rounding), "");
    const ToolSurface surface = make_surface(wild, rounding);
    Places places(3);
    for (int i = 0; i < 50000; ++i) {
      const Vec2 at = i % 2 == 0 ? places.next()  // or around a corner
                                 : wild[static_cast<std::size_t>(i / 2) % wild.size()] +
                                       0.1 * Vec2(places.unit(), places.unit());
      const Vec2 step = 1e-3 * Vec2(places.unit(), places.unit());
      ASSERT_LE(std::abs(nearest(surface, at + step - wild[0]).distance -
                         nearest(surface, at - wild[0]).distance),
                step.norm() + 1e-12)
          << at.transpose();
    }
  }
}

TEST(SurfaceDistance, NormalIsItsGradient) {
  const ToolSurface surface = make_surface(wild, 0.05);
  Places places(4);
  int kinks = 0;  // where two pieces are equally near: the distance has no gradient
  for (int i = 0; i < 5000; ++i) {
    const Vec2 at = places.next();
    const auto here = nearest(surface, at);
    const Vec2 n(here.nx, here.ny);
    EXPECT_NEAR(n.norm(), 1, 1e-12);
    const double h = 1e-6;
    const Vec2 gradient = Vec2(nearest(surface, at + Vec2(h, 0)).distance -
                                   nearest(surface, at - Vec2(h, 0)).distance,
                               nearest(surface, at + Vec2(0, h)).distance -
                                   nearest(surface, at - Vec2(0, h)).distance) /
                          (2 * h);
    if (std::abs(here.distance) < 1e-3) continue;
    if ((gradient - n).norm() > 1e-5) ++kinks;
  }
  EXPECT_LT(kinks, 5);
}

// Behind both flanks of a valley each feels what lies behind it; the way out of a corner is the nearer flank.
TEST(SurfaceDistance, FlanksOfValleysAndRidges) {
  const ToolSurface valley = make_surface({{-1, 1}, {0, 0}, {1, 1}}, 0);
  const Vec2 start(-1, 1);
  const double half = std::sqrt(0.5);
  const auto left = nearest(valley, Vec2(-0.6, 0.5) - start);
  EXPECT_NEAR(left.distance, -0.1 * half, 1e-15);
  EXPECT_NEAR(left.nx, half, 1e-15);
  const auto right = nearest(valley, Vec2(0.6, 0.5) - start);
  EXPECT_NEAR(right.nx, -half, 1e-15);
  const auto bottom = nearest(valley, Vec2(0, -0.2) - start);
  EXPECT_NEAR(bottom.distance, -0.2, 1e-15);
  EXPECT_NEAR(bottom.ny, 1, 1e-15);
  const ToolSurface ridge = make_surface({{-1, -1}, {0, 0}, {1, -1}}, 0);
  const auto above = nearest(ridge, Vec2(0, 0.3) - Vec2(-1, -1));
  EXPECT_NEAR(above.distance, 0.3, 1e-15);
  EXPECT_NEAR(above.ny, 1, 1e-15);
  EXPECT_NEAR(nearest(ridge, Vec2(-0.1, -0.2) - Vec2(-1, -1)).distance, -0.1 * half, 1e-15);
}

TEST(SurfaceDistance, LanesGiveWhatScalarsGive) {
  const ToolSurface surface = make_surface(wild, 0.05);
  Places places(5);
  for (int i = 0; i < 1000; ++i) {
    Lane x{}, y{};
    for (int l = 0; l < lane_count; ++l) {
      const Vec2 at = places.next();
      x[l] = at.x();
      y[l] = at.y();
    }
    const int last = static_cast<int>(surface.pieces.size()) - 1;
    const auto lanes = kernels::nearest_on_surface(surface, 0, last, x, y, 1.0);
    for (int l = 0; l < lane_count; ++l) {
      const auto one =
          kernels::nearest_on_surface(surface, 0, last, double{x[l]}, double{y[l]}, 1.0);
      EXPECT_EQ(lanes.distance[l], one.distance);
      EXPECT_EQ(lanes.nx[l], one.nx);
      EXPECT_EQ(lanes.ny[l], one.ny);
    }
  }
}

// Within reach of a box the pieces that the search names give the same answer as all pieces.
TEST(SurfaceSearch, MissesNothingNear) {
  for (const Points& points : {wild, Points{{0, 0}, {1, 0.5}}}) {
    const ToolSurface surface = make_surface(points, points.size() > 2 ? 0.05 : 0.0);
    Places places(6);
    int near = 0, empty = 0;
    for (int i = 0; i < 20000; ++i) {
      const Vec2 low = places.next();
      const Vec2 size(0.3 * (1 + places.unit()), 0.3 * (1 + places.unit()));
      const double reach = 0.2;
      const Vec2 high = low + size;
      const PieceRange range =
          pieces_near(surface, {{low.x(), low.y()}, {high.x(), high.y()}}, reach);
      if (range.empty()) ++empty;
      const Vec2 at = low + size.cwiseProduct(Vec2(places.unit() + 1, places.unit() + 1)) / 2;
      const double truth = nearest(surface, at).distance;
      if (std::abs(truth) > reach) continue;
      ++near;
      ASSERT_EQ(kernels::nearest_on_surface(surface, range.first, range.last, at.x(), at.y(), reach)
                    .distance,
                truth);
    }
    EXPECT_GT(near, 1000);
    EXPECT_GT(empty, 1000);
  }
}

TEST(SurfaceSearch, NamesFewPiecesOfALongChain) {
  Points points;
  for (int i = 0; i <= 4096; ++i) points.push_back({i, i % 2});
  const ToolSurface surface = make_surface(points, 0.1);
  const PieceRange range = pieces_near(surface, {{1000.2, 1}, {1001.2, 1.5}}, 0.3);
  EXPECT_LE(range.first, 1000);
  EXPECT_GE(range.last, 1000);
  EXPECT_LE(range.last - range.first, 4);
}

}  // namespace
}  // namespace pulvis
