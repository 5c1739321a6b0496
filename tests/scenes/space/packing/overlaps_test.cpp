// Overlaps of bodies placed by hand: depths are those of closed forms, what touches is not refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenes/space/packing/overlaps.hpp"
#include "tests/scenes/space/packing/packed_scene.hpp"

namespace pulvis::space {
namespace {

using testing::HasSubstr;

constexpr double mm = 1e-3;

struct Place {
  int particle;
  Vec3 at;  // mm
  Rotation rotation = Rotation::Identity();
};

Scene placed(const std::vector<ParticleShape>& shapes, const std::vector<Place>& places) {
  Scene scene = scene_of(shapes, {});
  scene.space->packings.clear();
  for (const Place& place : places) {
    BodySpec body;
    body.particle = place.particle;
    body.position = mm * place.at;
    body.rotation = place.rotation;
    body.mark = {10 + static_cast<int>(scene.space->bodies.size()), 1};
    scene.space->bodies.push_back(body);
  }
  return scene;
}

std::vector<SceneProblem> problems_of(const Scene& scene) {
  try {
    check_overlaps(scene, place_bodies(scene));
  } catch (const SceneError& error) {
    return error.errors();
  }
  return {};
}

TEST(OverlapsInSpace, OfBallsHaveTheDepthOfTheirDistance) {
  const Scene scene =
      placed({SphereShape{10 * mm}}, {{0, {0, 0, 0}}, {0, {6, 0, 7.5}}, {0, {20, 0, 0}}});
  const auto problems = problems_of(scene);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].line, 11);
  EXPECT_EQ(problems[0].key, "body[1].position");
  // 10 - sqrt(36 + 56.25) mm
  EXPECT_THAT(problems[0].message,
              HasSubstr("particle 1 ('a' at (0.006, 0, 0.0075) m) overlaps particle 0 "
                        "('a' at (0, 0, 0) m) by 0.000395314 m, allowed: particles that "
                        "touch or are apart"));
}

TEST(OverlapsInSpace, WhatTouchesIsNotRefused) {
  const std::vector<ParticleShape> shapes{
      SphereShape{10 * mm}, EllipsoidShape{Vec3(20, 10, 8) * mm},
      CylinderShape{10 * mm, 4 * mm, 1 * mm}, SuperquadricShape{Vec3(10, 10, 10) * mm, 8, 8}};
  const std::vector<Place> places{{0, {0, 0, 0}},  {1, {15, 0, 0}}, {2, {0, 0, 7}},
                                  {2, {0, 0, 11}}, {3, {0, 0, 18}}, {2, {30, 0, 0}}};
  EXPECT_TRUE(problems_of(placed(shapes, places)).empty());
}

// Along the common axis: 4 mm high cylinders 3.9 mm apart; ellipsoids 20 mm long 19.5 mm apart.
TEST(OverlapsInSpace, OfOtherShapesHaveTheDepthAlongTheirAxis) {
  const std::vector<ParticleShape> shapes{CylinderShape{10 * mm, 4 * mm, 1 * mm},
                                          EllipsoidShape{Vec3(20, 10, 8) * mm}};
  EXPECT_THAT(problems_of(placed(shapes, {{0, {0, 0, 0}}, {0, {1, 0, 3.9}}})).at(0).message,
              HasSubstr("by 0.0001 m"));
  EXPECT_THAT(problems_of(placed(shapes, {{1, {0, 0, 0}}, {1, {19.5, 0, 0}}})).at(0).message,
              HasSubstr("by 0.0005 m"));
}

ToolSpec plane_at(const Vec3& point, const Vec3& normal) {
  ToolSpec tool;
  tool.name = "wall";
  tool.point = point * mm;
  tool.normal = normal;
  tool.mark = {3, 1};
  return tool;
}

TEST(OverlapsInSpace, BehindAPlaneAreToldWithTheirDepth) {
  Scene scene = placed({EllipsoidShape{Vec3(20, 10, 8) * mm}}, {{0, {9.5, 0, 0}}, {0, {50, 0, 0}}});
  scene.space->tools = {plane_at({0, 0, 0}, {1, 0, 0})};
  const auto problems = problems_of(scene);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_THAT(problems[0].message,
              HasSubstr("is outside the die: it reaches 0.0005 m behind tool 'wall'"));
}

TEST(OverlapsInSpace, APlaneThatFacesAwayIsToldOnce) {
  Scene scene = placed({SphereShape{10 * mm}}, {{0, {5, 0, 0}}, {0, {50, 0, 0}}});
  scene.space->tools = {plane_at({0, 0, 0}, {-1, 0, 0})};
  const auto problems = problems_of(scene);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].line, 3);
  EXPECT_THAT(problems[0].message,
              HasSubstr("faces away from the powder: every particle lies behind it, allowed: "
                        "the normal out of the tool into the powder, [1, 0, 0]"));
}

// Along y: a ball 24.5 mm off the axis of a die of 60 mm fits with half a millimetre, one 25.2 mm off reaches 0.2 mm behind.
TEST(OverlapsInSpace, OfARoundDieAlongAnyAxis) {
  Scene scene = placed({SphereShape{10 * mm}}, {{0, {24.5, 7, 0}}, {0, {0, 90, 25.2}}});
  ToolSpec die = plane_at({0, 0, 0}, {0, 1, 0});
  die.shape = ToolSpec::Shape::die;
  die.diameter = 60 * mm;
  scene.space->tools = {die};
  const auto problems = problems_of(scene);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_THAT(problems[0].message, HasSubstr("particle 1"));
  EXPECT_THAT(problems[0].message, HasSubstr("reaches 0.0002 m behind tool 'wall'"));
}

// An edge-on tablet in a die: its rim touches at two points that are not on the line through axis and centre.
TEST(OverlapsInSpace, OfATabletInADieAreThoseOfItsRim) {
  const Rotation on_edge(std::sqrt(0.5), std::sqrt(0.5), 0, 0);  // its axis along y
  Scene scene = placed({CylinderShape{12 * mm, 16 * mm, 0}}, {{0, {0, 0, 0}, on_edge}});
  ToolSpec die = plane_at({0, 0, 0}, {0, 0, 1});
  die.shape = ToolSpec::Shape::die;
  die.diameter = 20 * mm;  // = the diagonal of 12 mm x 16 mm
  scene.space->tools = {die};
  EXPECT_TRUE(problems_of(scene).empty());
  scene.space->tools[0].diameter = 19.8 * mm;
  EXPECT_THAT(problems_of(scene).at(0).message, HasSubstr("reaches 0.0001 m behind"));
}

TEST(OverlapsInSpace, AreListedTwentyAtMost) {
  std::vector<Place> places;
  for (int i = 0; i < 30; ++i) places.push_back({0, {i * 9.0, 0, 0}});
  const auto problems = problems_of(placed({SphereShape{10 * mm}}, places));
  ASSERT_EQ(problems.size(), 21u);
  EXPECT_EQ(problems.back().message, "there are more overlaps, not listed");
}

}  // namespace
}  // namespace pulvis::space
