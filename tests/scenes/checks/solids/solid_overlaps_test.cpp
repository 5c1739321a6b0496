// Overlaps of bodies placed by hand: depths are those of closed forms, what touches is not refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "scenes/checks/overlaps.hpp"
#include "tests/scenes/packing/solids/packed_scene.hpp"

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
  scene.packings.clear();
  for (const Place& place : places) {
    BodySpec body;
    body.particle = place.particle;
    body.position = mm * place.at;
    body.rotation = place.rotation;
    body.mark = {10 + static_cast<int>(scene.bodies.size()), 1};
    scene.bodies.push_back(body);
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
  scene.tools = {plane_at({0, 0, 0}, {1, 0, 0})};
  const auto problems = problems_of(scene);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_THAT(problems[0].message,
              HasSubstr("is outside the die: it reaches 0.0005 m behind tool 'wall'"));
}

TEST(OverlapsInSpace, APlaneThatFacesAwayIsToldOnce) {
  Scene scene = placed({SphereShape{10 * mm}}, {{0, {5, 0, 0}}, {0, {50, 0, 0}}});
  scene.tools = {plane_at({0, 0, 0}, {-1, 0, 0})};
  const auto problems = problems_of(scene);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].line, 3);
  EXPECT_THAT(problems[0].message,
              HasSubstr("faces away from the powder: every particle lies behind it, allowed: a "
                        "normal that points from the tool into the powder, [1, 0, 0]"));
}

// Along y: a ball 24.5 mm off the axis of a die of 60 mm fits with half a millimetre, one 25.2 mm off reaches 0.2 mm behind.
TEST(OverlapsInSpace, OfARoundDieAlongAnyAxis) {
  Scene scene = placed({SphereShape{10 * mm}}, {{0, {24.5, 7, 0}}, {0, {0, 90, 25.2}}});
  ToolSpec die = plane_at({0, 0, 0}, {0, 1, 0});
  die.shape = ToolSpec::Shape::die;
  die.diameter = 60 * mm;
  scene.tools = {die};
  const auto problems = problems_of(scene);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_THAT(problems[0].message, HasSubstr("particle 1"));
  EXPECT_THAT(problems[0].message, HasSubstr("reaches 0.0002 m behind tool 'wall'"));
}

// Above the mouth of a die there is room beside it; a ball that stands in its face or in its edge does not fit.
TEST(OverlapsInSpace, OfARoundDieEndAtItsMouth) {
  Scene scene = placed({SphereShape{10 * mm}}, {{0, {50, 0, 25.1}}, {0, {0, 50, 24.9}}});
  ToolSpec die = plane_at({0, 0, 0}, {0, 0, 1});
  die.shape = ToolSpec::Shape::die;
  die.diameter = 60 * mm;
  die.height = 20 * mm;
  scene.tools = {die};
  const auto problems = problems_of(scene);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_THAT(problems[0].message, HasSubstr("particle 1"));
  EXPECT_THAT(problems[0].message, HasSubstr("reaches 0.0001 m into tool 'wall'"));
}

// An edge-on tablet in a die: its rim touches at two points that are not on the line through axis and centre.
TEST(OverlapsInSpace, OfATabletInADieAreThoseOfItsRim) {
  const Rotation on_edge(std::sqrt(0.5), std::sqrt(0.5), 0, 0);  // its axis along y
  Scene scene = placed({CylinderShape{12 * mm, 16 * mm, 0}}, {{0, {0, 0, 0}, on_edge}});
  ToolSpec die = plane_at({0, 0, 0}, {0, 0, 1});
  die.shape = ToolSpec::Shape::die;
  die.diameter = 20 * mm;  // = the diagonal of 12 mm x 16 mm
  scene.tools = {die};
  EXPECT_TRUE(problems_of(scene).empty());
  scene.tools[0].diameter = 19.8 * mm;
  EXPECT_THAT(problems_of(scene).at(0).message, HasSubstr("reaches 0.0001 m behind"));
}

ToolSpec punch_down(double height, std::vector<Vec2> profile) {
  ToolSpec punch = plane_at({0, 0, height}, {0, 0, -1});
  punch.shape = ToolSpec::Shape::punch;
  punch.diameter = 60 * mm;
  for (const Vec2& place : profile) punch.profile.emplace_back(mm * place);
  return punch;
}

// Under a cone of 45 degrees whose tip is 6 mm above the balls' centres: 6/sqrt(2) mm from it.
TEST(OverlapsInSpace, OfBallsInAPunchHaveTheDepthOfItsFace) {
  Scene scene = placed({SphereShape{10 * mm}}, {{0, {0, 0, 0}}, {0, {15, 0, 0}}});
  scene.tools = {punch_down(6, {{0, 0}, {30, 30}})};  // forward towards the rim
  const auto problems = problems_of(scene);
  ASSERT_EQ(problems.size(), 2u);
  EXPECT_THAT(problems[0].message, HasSubstr("particle 0"));
  EXPECT_THAT(problems[0].message, HasSubstr("reaches 0.000757359 m into tool 'wall', allowed: "
                                             "particles outside of every tool"));
  EXPECT_THAT(problems[1].message, HasSubstr("particle 1"));
  // Its tip forward, 5.1 mm above the first ball: both have room.
  scene.tools = {punch_down(5.1, {{0, 0}, {30, -30}})};
  EXPECT_TRUE(problems_of(scene).empty());
  scene.tools = {punch_down(4.9, {{0, 0}, {30, -30}})};
  EXPECT_THAT(problems_of(scene).at(0).message, HasSubstr("reaches 0.0001 m into"));
}

// A tablet on its edge under a flat punch: the highest place of its rim.
TEST(OverlapsInSpace, OfATabletInAPunchAreThoseOfItsRim) {
  const Rotation tilted(std::cos(0.3), std::sin(0.3), 0, 0);  // by 0.6 rad about x
  Scene scene = placed({CylinderShape{12 * mm, 4 * mm, 0}}, {{0, {0, 0, 0}, tilted}});
  const double top = 6 * std::sin(0.6) + 2 * std::cos(0.6);  // mm
  scene.tools = {punch_down(top + 0.01, {})};
  EXPECT_TRUE(problems_of(scene).empty());
  scene.tools = {punch_down(top - 0.1, {})};
  EXPECT_THAT(problems_of(scene).at(0).message, HasSubstr("reaches 0.0001 m into"));
}

ToolSpec tetrahedron_tool(double size) {
  ToolSpec tool = plane_at({0, 0, 0}, {0, 0, 1});
  tool.shape = ToolSpec::Shape::stl;
  const Vec3 o = Vec3::Zero(), x = size * mm * Vec3::UnitX(), y = size * mm * Vec3::UnitY(),
             z = size * mm * Vec3::UnitZ();
  tool.triangles = {{o, y, x}, {o, x, z}, {o, z, y}, {x, y, z}};
  return tool;
}

// Beside a corner of a cube: at its edge, in front of its face, and wholly inside, away from all of its triangles.
TEST(OverlapsInSpace, OfBallsInAnStlTool) {
  Scene scene =
      placed({SphereShape{2 * mm}},
             {{0, {50, -0.9, 20}}, {0, {40, -1.1, 10}}, {0, {20, 20, 20}}, {0, {50, 50, 50}}});
  scene.tools = {tetrahedron_tool(100)};
  const auto problems = problems_of(scene);
  ASSERT_EQ(problems.size(), 2u);
  EXPECT_THAT(problems[0].message, HasSubstr("particle 0"));
  EXPECT_THAT(problems[0].message, HasSubstr("reaches 0.0001 m into tool 'wall'"));
  EXPECT_THAT(problems[1].message, HasSubstr("particle 2"));
  EXPECT_THAT(problems[1].message, HasSubstr("reaches 0.021 m into tool 'wall'"));
}

// An edge of the tool 0.1 mm deep in the middle of a box's face: no corner of either is in the other.
TEST(OverlapsInSpace, OfAFaceOnAnEdgeOfAnStlTool) {
  const Rotation turned(std::cos(std::numbers::pi / 8), std::sin(std::numbers::pi / 8), 0, 0);
  const auto at = [&](double depth) {
    const double off = -(5 - depth) / std::numbers::sqrt2;
    Scene scene =
        placed({SuperquadricShape{Vec3(10, 10, 10) * mm, 8, 8}}, {{0, {50, off, off}, turned}});
    scene.tools = {tetrahedron_tool(100)};
    return problems_of(scene);
  };
  EXPECT_TRUE(at(-0.01).empty());
  const auto problems = at(0.1);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_THAT(problems[0].message, HasSubstr("into tool 'wall'"));
}

TEST(OverlapsInSpace, AreListedTwentyAtMost) {
  std::vector<Place> places;
  for (int i = 0; i < 30; ++i) places.push_back({0, {i * 9.0, 0, 0}});
  const auto problems = problems_of(placed({SphereShape{10 * mm}}, places));
  ASSERT_EQ(problems.size(), 21u);
  EXPECT_EQ(problems.back().message, "there are more overlaps that are not listed");
}

}  // namespace
}  // namespace pulvis::space
