// Distances, overlaps and pieces of rigid particles against plane geometry.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scenes/packing/outlines/convex_pieces.hpp"
#include "scenes/packing/outlines/rigid_contact.hpp"

namespace pulvis {
namespace {

using portable::V2;

double gap_of(const Outline& a, RigidPose at_a, const Outline& b, RigidPose at_b) {
  RigidContacts contacts;
  const RigidShape shape_a = rigid_shape(a, 1, 1e-4), shape_b = rigid_shape(b, 1, 1e-4);
  double minimum = 1e9;
  for (const RigidTouch& t : contacts.between(shape_a, at_a, shape_b, at_b, 10))
    minimum = std::min(minimum, t.gap);
  return minimum;
}

portable::Turn degrees(double angle) {
  const double a = angle * std::numbers::pi / 180;
  return {std::cos(a), std::sin(a)};
}

TEST(RigidContact, GapsAreThoseOfPlaneGeometry) {
  const DiscOutline disc{2};
  const RectangleOutline square{2, 2};
  const RoundedRectangleOutline stadium{4, 2, 1};
  EXPECT_NEAR(gap_of(disc, {{0, 0}, {}}, disc, {{3, 4}, {}}), 3, 1e-12);
  EXPECT_NEAR(gap_of(disc, {{0, 0}, {}}, disc, {{1.2, 0}, {}}), -0.8, 1e-12);
  EXPECT_NEAR(gap_of(square, {{0, 0}, {}}, square, {{2.5, 0.7}, {}}), 0.5, 1e-12);
  EXPECT_NEAR(gap_of(square, {{0, 0}, {}}, square, {{5, 6}, {}}), 5, 1e-12);  // corner to corner
  EXPECT_NEAR(gap_of(square, {{0, 0}, {}}, square, {{1.9, 0.3}, {}}), -0.1, 1e-12);
  EXPECT_NEAR(gap_of(square, {{0, 0}, {}}, square, {{3, 0}, degrees(45)}), 2 - std::sqrt(2), 1e-12);
  EXPECT_NEAR(gap_of(square, {{0, 0}, {}}, disc, {{4, 5}, {}}), 4, 1e-12);
  EXPECT_NEAR(gap_of(disc, {{4, 5}, {}}, square, {{0, 0}, degrees(90)}), 4, 1e-12);
  EXPECT_NEAR(gap_of(disc, {{1.5, 0}, {}}, square, {{0, 0}, {}}), -0.5, 1e-12);
  EXPECT_NEAR(gap_of(stadium, {{0, 0}, {}}, stadium, {{5, 0}, {}}), 1, 1e-12);  // end to end
  EXPECT_NEAR(gap_of(stadium, {{0, 0}, {}}, stadium, {{0, 2.5}, degrees(180)}), 0.5, 1e-12);
}

TEST(RigidContact, FlatSidesTouchTwice) {
  RigidContacts contacts;
  const RigidShape square = rigid_shape(RectangleOutline{2, 2}, 1, 1e-4);
  const auto& touches = contacts.between(square, {{0, 0}, {}}, square, {{1.99, 1}, {}}, 0);
  ASSERT_EQ(touches.size(), 2U);
  EXPECT_NEAR(std::abs(touches[0].point.y - touches[1].point.y), 1, 1e-12);
  for (const RigidTouch& t : touches) EXPECT_NEAR(t.normal.x, 1, 1e-12);
}

TEST(RigidShape, HasTheMomentsOfItsOutline) {
  const RigidShape r = rigid_shape(RectangleOutline{4, 2}, 2, 1e-4);
  EXPECT_NEAR(r.content, 2, 1e-9);
  EXPECT_NEAR(r.gyration, (4.0 + 1.0) / 12, 1e-9);
  EXPECT_NEAR(r.min_width, 1, 1e-12);
  EXPECT_NEAR(r.reach, std::sqrt(1.25), 1e-9);
}

// A curve through more points than a rigid shape may have corners: corners are left out.
TEST(RigidShape, HasFewCornersOfACurveThroughManyPoints) {
  PointsOutline disc;
  for (int i = 0; i < 3000; ++i) {
    const double angle = 2 * std::numbers::pi * i / 3000;
    disc.points.emplace_back(std::cos(angle), std::sin(angle));
  }
  const RigidShape r = rigid_shape(disc, 1, 1e-4);
  ASSERT_EQ(r.pieces.size(), 1U);
  EXPECT_GT(r.pieces[0].corners.size(), 60U);
  EXPECT_LE(r.pieces[0].corners.size(), 240U);
  EXPECT_NEAR(r.content, std::numbers::pi, 1e-3);
  EXPECT_NEAR(r.pieces[0].radius, 2e-4, 1e-12);  // of the polygon, and of what is left out
  EXPECT_GE(r.reach, 1);
  const RigidPose here{{0, 0}, {}}, beside{{3, 0}, {}};
  EXPECT_NEAR(gap_of(disc, here, disc, beside), 1, 4e-4);
}

double area_of(const std::vector<V2>& p) {
  double twice = 0;
  for (std::size_t i = 0; i < p.size(); ++i) twice += portable::cross(p[i], p[(i + 1) % p.size()]);
  return twice / 2;
}

TEST(ConvexPieces, FillThePolygonAndAreConvex) {
  const std::vector<V2> hook{{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 3}, {3, 3}, {3, 4}, {0, 4}};
  const auto pieces = convex_pieces(hook);
  double area = 0;
  for (const auto& piece : pieces) {
    area += area_of(piece);
    for (std::size_t i = 0; i < piece.size(); ++i) {
      const V2 a = piece[i], b = piece[(i + 1) % piece.size()], c = piece[(i + 2) % piece.size()];
      EXPECT_GE(portable::cross(b - a, c - b), 0);
    }
  }
  EXPECT_NEAR(area, area_of(hook), 1e-12);
  EXPECT_LE(pieces.size(), 5U);
  EXPECT_EQ(convex_pieces({{0, 0}, {1, 0}, {1, 1}, {0, 1}}).size(), 1U);
}

}  // namespace
}  // namespace pulvis
