// An outline against itself: which points see a fold, and which their own body.
#include "systems/contact/own_outline.hpp"

#include <gtest/gtest.h>

#include "tests/systems/contact/closed_curve.hpp"

namespace pulvis {
namespace {

// Two legs on a foot, `gap` between them; negative where they overlap. Edges are 1 long.
struct TwoLegs {
  static constexpr int height = 20, foot = 4;

  TwoLegs(double gap, double thickness) : curve(outline(gap, thickness)) {}

  static std::vector<Point> outline(double gap, double thickness) {
    const double in = 0.5 * gap, out = in + thickness, top = height, low = foot;
    std::vector<Point> points;
    const auto side = [&](Point from, Point to, int edges) {
      for (int i = 0; i < edges; ++i) {
        const double share = static_cast<double>(i) / edges;
        points.push_back(
            {from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1])});
      }
    };
    side({-out, 0}, {out, 0}, 4);
    side({out, 0}, {out, top}, height);
    side({out, top}, {in, top}, 1);
    side({in, top}, {in, low}, height - foot);
    side({in, low}, {-in, low}, 1);
    side({-in, low}, {-in, top}, height - foot);
    side({-in, top}, {-out, top}, 1);
    side({-out, top}, {-out, 0}, height);
    return points;
  }
  // The edge whose middle is nearest to a point.
  int edge_at(const Point& p) const {
    int nearest = 0;
    double minimum = 1e300;
    for (int e = 0; e < curve.edges(); ++e) {
      const Point m = Curve(curve.control.data() + 2 * e).value(0.5);
      const double distance = std::hypot(m[0] - p[0], m[1] - p[1]);
      if (distance < minimum) minimum = distance, nearest = e;
    }
    return nearest;
  }
  // What the second Gauss point of the edge at `from` sees from the edge at `to` on.
  OwnSight sight(const Point& from, const Point& to, bool touched = false) const {
    const int edge = edge_at(from);
    std::array<Point, lane_count> points;
    points.fill(Curve(curve.control.data() + 2 * edge).value(kernels::edge_u[1]));
    std::array<int, lane_count> start;
    start.fill(edge_at(to));
    Projection p = curve.look_from(points, start);
    project(curve.bodies, p);
    const PointMotion m = motion_of(p, {});
    const OwnOutline own(curve.bodies.shapes[0], curve.control.data());
    return own_sight(p, m, 1, edge, 1, own, touched);
  }

  ClosedCurve curve;
};

constexpr double halfway = 12.5;  // halfway up the legs

TEST(OwnOutline, LegsThatAreApartSeeEachOtherFromOutside) {
  const TwoLegs legs(0.1, 3);
  EXPECT_EQ(legs.sight({0.05, halfway}, {-0.05, halfway}), OwnSight::outside);
  EXPECT_EQ(legs.sight({-0.05, halfway}, {0.05, halfway}), OwnSight::outside);
}

TEST(OwnOutline, LegsThatOverlapAreAFold) {
  const TwoLegs legs(-0.05, 3);
  EXPECT_EQ(legs.sight({-0.025, halfway}, {0.025, halfway}), OwnSight::fold);
  EXPECT_EQ(legs.sight({0.025, halfway}, {-0.025, halfway}), OwnSight::fold);
}

// As deep at once it is none, unless it has touched before.
TEST(OwnOutline, AFoldDoesNotBeginDeep) {
  const TwoLegs legs(-2 * deepest_begin, 3);
  EXPECT_EQ(legs.sight({-deepest_begin, halfway}, {deepest_begin, halfway}, false),
            OwnSight::inside);
  EXPECT_EQ(legs.sight({-deepest_begin, halfway}, {deepest_begin, halfway}, true), OwnSight::fold);
}

// A leg as thin as a fold is deep: only the turns of the outline tell them apart.
TEST(OwnOutline, TheBackFaceOfAThinLegIsNoFold) {
  const TwoLegs legs(6, 0.05);
  EXPECT_EQ(legs.sight({3.05, halfway}, {3, halfway}), OwnSight::inside);
  EXPECT_EQ(legs.sight({3, halfway}, {3.05, halfway}), OwnSight::inside);
}

TEST(OwnOutline, ItsOwnEdgesAreItsNeighbourhood) {
  const TwoLegs legs(6, 3);
  EXPECT_EQ(legs.sight({3, halfway}, {3, halfway}), OwnSight::neighbourhood);
  EXPECT_EQ(legs.sight({3, halfway}, {3, halfway + 1}), OwnSight::neighbourhood);
}

TEST(OwnOutline, ExcludesWhatIsNoFoldAndTellsHowNearTheOthersAre) {
  const TwoLegs apart(0.1, 3);
  const int edge = apart.edge_at({0.05, halfway});
  const Curve sampled(apart.curve.control.data() + 2 * edge);
  std::array<Point, lane_count> points;
  for (int l = 0; l < lane_count; ++l) entry(points, l) = sampled.value(kernels::edge_u[l % 4]);
  std::array<int, lane_count> start;
  start.fill(apart.edge_at({-0.05, halfway}));
  Projection p = apart.curve.look_from(points, start);
  project(apart.curve.bodies, p);
  PointMotion m = motion_of(p, {});
  const OwnOutline own(apart.curve.bodies.shapes[0], apart.curve.control.data());
  EXPECT_NEAR(exclude_own_body(p, 1, edge, own, 0, m), 0.1, 1e-12);

  start.fill(edge);  // of its own edge each point is the closest
  p = apart.curve.look_from(points, start);
  project(apart.curve.bodies, p);
  m = motion_of(p, {});
  EXPECT_EQ(exclude_own_body(p, 1, edge, own, 0, m), back_face);
  for (int l = 4; l < lane_count; ++l) EXPECT_EQ(m.gap[l], -1);
}

}  // namespace
}  // namespace pulvis
