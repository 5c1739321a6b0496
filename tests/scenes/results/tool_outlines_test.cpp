// What a run writes once about its particles and its tools: tags by number, and bodies with an end around tools that
// have none.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenes/results/particle_tags.hpp"
#include "scenes/results/tool_outlines.hpp"
#include "tests/helpers/experiment.hpp"
#include "tests/helpers/right_scene.hpp"

namespace pulvis {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

struct Outline {
  std::vector<Vec2> face, behind;
};

// Of the tool of that name in the frame as it would be written now.
Outline outline_of(const Experiment& e, const std::string& tool) {
  const RunMesh mesh = e.results.mesh();
  const std::vector<double> xy = e.results.frame().back();
  EXPECT_EQ(e.results.fields().back().name, "tools/outline");
  EXPECT_EQ(xy.size(), 2 * mesh.tools.points());
  const auto wanted = std::ranges::find(mesh.tools.names, tool) - mesh.tools.names.begin();
  std::vector<Vec2> points;
  for (std::size_t i = 0; i < mesh.tools.tool.size(); ++i)
    if (mesh.tools.tool[i] == wanted) points.emplace_back(xy[2 * i], xy[2 * i + 1]);
  EXPECT_GE(points.size(), 4U) << tool;
  return {{points.begin(), points.end() - 2}, {points.end() - 2, points.end()}};
}

double* place_of(Experiment& e, const std::string& tool) {
  for (std::size_t t = 0; t < e.scene.tools.size(); ++t)
    if (e.scene.tools[t].name == tool)
      return e.simulation.world().column<ToolPosition>().values() + tool_axes * t;
  ADD_FAILURE() << "no tool " << tool;
  return nullptr;
}

TEST(ToolOutlines, MakePunchesAsWideAsTheDie) {
  Experiment e("compaction/regular-25.toml");
  for (const auto& [tool, height] : {std::pair("bottom", 0.0), {"top", 50e-3}}) {
    const Outline punch = outline_of(e, tool);
    ASSERT_EQ(punch.face.size(), 2U);
    EXPECT_NEAR(std::min(punch.face[0].x(), punch.face[1].x()), place_of(e, "left")[0], 1e-12);
    EXPECT_NEAR(std::max(punch.face[0].x(), punch.face[1].x()), place_of(e, "right")[0], 1e-12);
    for (const Vec2& p : punch.face) EXPECT_NEAR(p.y(), place_of(e, tool)[1], 1e-12);
    for (const Vec2& p : punch.behind)
      EXPECT_GT(std::abs(p.y() - 25e-3), std::abs(height - 25e-3) + 1e-3) << tool;
  }
}

TEST(ToolOutlines, FollowThePunchAndLeaveTheWallsAsTheyWere) {
  Experiment e("compaction/regular-25.toml");
  const Outline punch = outline_of(e, "top"), wall = outline_of(e, "left");
  place_of(e, "top")[1] -= 7e-3;
  const Outline after = outline_of(e, "top"), wall_after = outline_of(e, "left");
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(after.face[i].y(), punch.face[i].y() - 7e-3, 1e-12);
    EXPECT_NEAR(after.behind[i].y(), punch.behind[i].y() - 7e-3, 1e-12);
    EXPECT_EQ(wall_after.face[i], wall.face[i]);
  }
  EXPECT_GT(std::abs(wall.face[0].y() - wall.face[1].y()),
            50e-3);                 // the wall holds all of the powder
  place_of(e, "right")[0] += 1e-3;  // a die that gives
  const Outline wider = outline_of(e, "top");
  EXPECT_NEAR(std::abs(wider.face[0].x() - wider.face[1].x()), 51e-3, 1e-9);
}

TEST(ToolOutlines, CloseEachToolByLinesOfItsOwn) {
  const Experiment e("compaction/regular-25.toml");
  const ToolLines lines = e.results.mesh().tools;
  EXPECT_EQ(lines.names.size(), 4U);
  ASSERT_EQ(lines.ends.size(), 2 * lines.tool.size());
  std::vector<int> seen(lines.points());
  for (std::size_t i = 0; i < lines.tool.size(); ++i) {
    const auto from = static_cast<std::size_t>(lines.ends[2 * i]),
               to = static_cast<std::size_t>(lines.ends[2 * i + 1]);
    EXPECT_EQ(lines.tool[from], lines.tool[to]);
    ++seen.at(from), ++seen.at(to);
  }
  EXPECT_THAT(seen, Each(2));
}

TEST(ToolOutlines, KeepThePointsOfAPolylineAndLieBehindThem) {
  const Experiment e("basic/groove-wedge.toml");
  for (const ToolSpec& tool : e.scene.tools) {
    if (tool.shape != ToolSpec::Shape::polyline) continue;
    const Outline outline = outline_of(e, tool.name);
    for (const Vec2& p : tool.points) {  // a corner into the powder is rounded
      const bool is_end = p == tool.points.front() || p == tool.points.back();
      double nearest = 1;
      for (const Vec2& q : outline.face) nearest = std::min(nearest, (p - q).norm());
      EXPECT_LT(nearest, 1e-9 + (is_end ? 0 : tool.rounding)) << tool.name;
    }
    double lowest = 1e9;
    for (const Vec2& p : outline.face) lowest = std::min(lowest, p.y());
    for (const Vec2& p : outline.behind) EXPECT_LT(p.y(), lowest);
    return;
  }
  FAIL() << "the scene has no polyline";
}

TEST(ParticleTags, AreByNumberAndNamed) {
  const Scene scene = load_scene_text(right_scene, "right.toml", {}).scene;
  const Experiment e(scene);
  const std::vector<ParticleTag> tags = e.results.mesh().tags;
  ASSERT_EQ(tags.size(), 3U);
  EXPECT_EQ(tags[0].name, "number");
  EXPECT_THAT(tags[0].values, ElementsAre(0, 1, 2, 3, 4));
  EXPECT_EQ(tags[1].name, "material");
  EXPECT_THAT(tags[1].names, ElementsAre("316L"));
  EXPECT_THAT(tags[1].values, ElementsAre(0, 0, 0, 0, 0));
  EXPECT_EQ(tags[2].name, "class");
  EXPECT_THAT(tags[2].names, ElementsAre("grain", "block"));
  EXPECT_THAT(tags[2].values, ElementsAre(1, 0, 0, 0, 0));  // bodies stand before packings
}

TEST(ParticleTags, NameAGrainByTheClassOfItsParticle) {
  const Experiment e("bonds/crushed-particle.toml");
  const std::vector<ParticleTag> tags = e.results.mesh().tags;
  EXPECT_THAT(tags[2].names, Each(Not(HasSubstr("#"))));
  EXPECT_LT(tags[2].names.size(), e.scene.grains.size());
}

}  // namespace
}  // namespace pulvis
