// Projection: closest points on curves, against closed forms and a search by brute force.
#include "systems/contact/projection.hpp"

#include <gtest/gtest.h>

#include "systems/contact/contact_outlines.hpp"
#include "tests/helpers/random_values.hpp"
#include "tests/systems/contact/closed_curve.hpp"

namespace pulvis {
namespace {

constexpr int round_edges = 64;

std::array<int, lane_count> all_from(int edge) {
  std::array<int, lane_count> start;
  start.fill(edge);
  return start;
}

// A cubic B-spline of points on a circle is round to the fourth power of the angle between them.
TEST(Projection, OnACircleIsRadial) {
  const ClosedCurve circle = ClosedCurve::circle(1, round_edges);
  const double step = 2 * std::numbers::pi / round_edges, round = step * step * step * step;
  const double radius = (2 + std::cos(step)) / 3;  // of its knots
  kernels::Random random(1);
  for (int i = 0; i < 100; ++i) {
    std::array<Point, lane_count> points;
    std::array<int, lane_count> start;
    for (std::size_t l = 0; l < lane_count; ++l) {
      const double angle = random.in(0, 2 * std::numbers::pi), r = random.in(0.8, 1.2);
      points[l] = {r * std::cos(angle), r * std::sin(angle)};
      start[l] = (static_cast<int>(angle / step) + round_edges - 1) % round_edges;
    }
    Projection p = circle.look_from(points, start);
    project(circle.bodies, p);
    const PointMotion m = motion_of(p, {});
    ASSERT_EQ(p.unconverged(), 0U);
    for (int l = 0; l < lane_count; ++l) {
      const Point& at = entry(points, l);
      const double r = std::hypot(at[0], at[1]);
      ASSERT_NEAR(m.gap[l], radius - r, round);
      ASSERT_NEAR(m.nx[l], at[0] / r, round);
      ASSERT_NEAR(m.ny[l], at[1] / r, round);
      ASSERT_EQ(m.slip_rate[l], 0);
    }
  }
}

ClosedCurve clover() {
  std::vector<Point> points;
  for (int i = 0; i < round_edges; ++i) {
    const double angle = 2 * std::numbers::pi * i / round_edges, r = 1 + 0.2 * std::cos(3 * angle);
    points.push_back({r * std::cos(angle), r * std::sin(angle)});
  }
  return ClosedCurve(points);
}

struct Nearest {
  int edge = 0;
  double distance = 1e300;
};

constexpr int samples = 400;  // of an edge

Nearest nearest_of_all(const ClosedCurve& curve, const Point& p) {
  Nearest nearest;
  for (int e = 0; e < curve.edges(); ++e) {
    const Curve edge(curve.control.data() + 2 * e);
    for (int i = 0; i <= samples; ++i) {
      const Point m = edge.value(static_cast<double>(i) / samples);
      const double distance = std::hypot(p[0] - m[0], p[1] - m[1]);
      if (distance < nearest.distance) nearest = {e, distance};
    }
  }
  return nearest;
}

TEST(Projection, IsNoFartherThanAnyPointOfTheCurve) {
  const ClosedCurve curve = clover();
  kernels::Random random(2);
  for (int i = 0; i < 20; ++i) {
    std::array<Point, lane_count> points;
    std::array<int, lane_count> start;
    std::array<Nearest, lane_count> nearest;
    for (std::size_t l = 0; l < lane_count; ++l) {
      const double angle = random.in(0, 2 * std::numbers::pi);
      const double r = 1 + 0.2 * std::cos(3 * angle) + random.in(-0.1, 0.1);
      points[l] = {r * std::cos(angle), r * std::sin(angle)};
      nearest[l] = nearest_of_all(curve, points[l]);
      // Three edges off, as after a while without a look.
      start[l] = (nearest[l].edge + round_edges + (i % 2 == 0 ? 3 : -3)) % round_edges;
    }
    Projection p = curve.look_from(points, start);
    project(curve.bodies, p);
    ASSERT_EQ(p.unconverged(), 0U);
    for (int l = 0; l < lane_count; ++l) {
      const double found = std::hypot(p.rx[l], p.ry[l]), minimum = entry(nearest, l).distance;
      // Between two samples, h apart, a curve comes nearer than both by h/2 at most.
      ASSERT_LE(found, minimum + 1e-12);
      ASSERT_GE(found, minimum - 0.5 * 0.14 / samples);
    }
  }
}

// Each step goes over one edge at most: 60 edges away is too far for 41. The search goes on in the next step.
TEST(Projection, ThatUsesUpItsStepsSaysSoAndGoesOn) {
  constexpr int many = 200;
  const ClosedCurve circle = ClosedCurve::circle(1, many);
  std::array<int, lane_count> start = all_from(0);
  start[2] = start[5] = 60;
  std::array<Point, lane_count> points;
  points.fill({1.1, 0.01});
  Projection p = circle.look_from(points, start);
  project(circle.bodies, p);
  EXPECT_EQ(p.unconverged(), 1U << 2 | 1U << 5);
  EXPECT_LT(p.at.edge[2], 60 - 30);
  Projection next = circle.look_from(
      points, {0, 0, static_cast<int>(p.at.edge[2]), 0, 0, static_cast<int>(p.at.edge[5]), 0, 0});
  project(circle.bodies, next);
  EXPECT_EQ(next.unconverged(), 0U);
  for (int l = 0; l < lane_count; ++l)
    EXPECT_NEAR(std::hypot(next.rx[l], next.ry[l]), std::hypot(p.rx[0], p.ry[0]), 1e-12);
}

TEST(Projection, SideBySideIsTheSameAsOneByOne) {
  const ClosedCurve curve = clover();
  std::array<Point, lane_count> near, far;
  near.fill({1.25, 0.1}), far.fill({-0.4, 0.9});
  Projection a = curve.look_from(near, all_from(2)), b = curve.look_from(far, all_from(25));
  Projection a_alone = a, b_alone = b;
  project(curve.bodies, a, b);
  project(curve.bodies, a_alone);
  project(curve.bodies, b_alone);
  for (int l = 0; l < lane_count; ++l) {
    EXPECT_EQ(a.at.u[l], a_alone.at.u[l]);
    EXPECT_EQ(b.at.u[l], b_alone.at.u[l]);
  }
}

TEST(Projection, PastACornerIsOutside) {
  ClosedCurve circle = ClosedCurve::circle(1, round_edges);
  circle.shape().edges[3].next = circle.shape().edges[4].previous = Shape::no_edge;
  const double angle =
      2 * std::numbers::pi * 7 / round_edges;  // off edge 6: beyond the corner for edge 3
  std::array<Point, lane_count> points;
  points.fill({0.95 * std::cos(angle), 0.95 * std::sin(angle)});
  std::array<int, lane_count> start = all_from(6);
  start[1] = 3;
  Projection p = circle.look_from(points, start);
  project(circle.bodies, p);
  EXPECT_EQ(p.unconverged(), 0U);
  EXPECT_EQ(p.beyond, 1U << 1);
  const PointMotion m = motion_of(p, {});
  EXPECT_LT(m.gap[1], 0);
  EXPECT_GT(m.gap[0], 0);
}

TEST(Projection, CommonRigidMotionHasNoRates) {
  const ClosedCurve curve = clover();
  const double turn = 3, vx = 2, vy = -1;
  std::vector<double> velocity;
  for (std::size_t i = 0; i < curve.control.size(); i += 2) {
    velocity.push_back(vx - turn * curve.control[i + 1]);
    velocity.push_back(vy + turn * curve.control[i]);
  }
  std::array<Point, lane_count> points;
  for (std::size_t l = 0; l < lane_count; ++l)
    points[l] = {1.2 + 0.01 * static_cast<double>(l), 0.1};
  Projection p = curve.look_from(points, all_from(1));
  p.other.velocity = velocity.data();
  project(curve.bodies, p);
  const PointMotion m = motion_of(p, {vx - turn * p.points.y, vy + turn * p.points.x});
  for (int l = 0; l < lane_count; ++l) {
    EXPECT_NEAR(m.gap_rate[l], 0, 1e-14);
    // The closest point is where its last step began: 2e-6 of an edge off, 0.1 wide, at most.
    EXPECT_NEAR(m.slip_rate[l], 0, 2e-7 * turn);
  }
}

TEST(CurvePoint, IsTheSameAfterPacking) {
  for (const int edge : {0, 7, 1023})
    for (const double u : {0.0, 0.25, 0.5, 0.999}) {
      const CurvePoint back = CurvePoint{edge, u}.packed().unpacked();
      EXPECT_EQ(back.edge, edge);
      EXPECT_NEAR(back.u, u, 1e-12);
    }
  EXPECT_EQ((CurvePoint{5, 1.0}.packed().unpacked().edge), 5);  // an end belongs to its own edge
}

}  // namespace
}  // namespace pulvis
