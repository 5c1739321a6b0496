// Faces of tools from drawings: the same points as if they were written down, the powder on the side that is said.
#include "scenes/tools/drawn_face.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "scenes/read.hpp"
#include "tests/helpers/paths.hpp"
#include "tests/helpers/right_scene.hpp"

namespace pulvis {
namespace {

using testing::HasSubstr;

void expect_near(const std::vector<Vec2>& points, const std::vector<Vec2>& expected) {
  ASSERT_EQ(points.size(), expected.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    EXPECT_NEAR((points[i] - expected[i]).norm(), 0, 1e-15) << i;
}

TEST(PlacedFace, HasThePowderToItsLeft) {
  const std::vector<Vec2> right{{0, 0}, {1, 0.5}, {2, 0}}, left{{2, 0}, {1, 0.5}, {0, 0}};
  expect_near(placed_face(right, {0, 1}, nullptr), right);
  expect_near(placed_face(left, {0, 1}, nullptr), right);
  expect_near(placed_face(right, {0, -1}, nullptr), left);
}

// Of a punch from above the lowest place is level with the point, of one from the side the middle is beside it.
TEST(PlacedFace, IsMovedToItsPoint) {
  const Vec2 point(10, 3);
  expect_near(placed_face({{2, 0}, {1, -0.5}, {0, 0}}, {0, -1}, &point),
              {{11, 3.5}, {10, 3}, {9, 3.5}});
  expect_near(placed_face({{0, 2}, {0, 0}}, {1, 0}, &point), {{10, 4}, {10, 2}});
}

class DrawnFace : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(testing::TempDir()) / (std::string("face_") + test->name());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  void draw(const std::string& inside, const std::string& width = "width='40mm' ") const {
    std::ofstream(folder_ / "face.svg")
        << "<svg " << width << "viewBox='0 0 40 40' xmlns:inkscape='i'>" << inside << "</svg>";
  }
  // The right scene under a top that is drawn; `keys` in place of its plane.
  std::string scene(const std::string& keys) const {
    std::string text = right_scene;
    const std::string plane =
        "shape = \"plane\"\npoint = [\"0 mm\", \"30 mm\"]\nnormal = [0, -1]\n";
    text.replace(text.find(plane), plane.size(), "shape = \"polyline\"\n" + keys);
    return text;
  }
  LoadedScene load(const std::string& keys) const {
    return load_scene_text(scene(keys), folder_ / "scene.toml");
  }
  std::string fault(const std::string& keys) const {
    return message_of([&] { load(keys); });
  }
  std::vector<Vec2> top(const std::string& keys) const { return load(keys).scene.tools[1].points; }

  std::filesystem::path folder_;
};

const std::string drawn = "file = \"face.svg\"\nnormal = [0, -1]\n";

// 40 units are 40 mm, y points down: as if its corners were written down.
TEST_F(DrawnFace, HasTheCornersOfItsDrawing) {
  draw("<path d='M0 -32H10L20 -31L30 -32H40'/>");
  expect_near(top(drawn), {{0.04, 0.032}, {0.03, 0.032}, {0.02, 0.031}, {0.01, 0.032}, {0, 0.032}});
}

TEST_F(DrawnFace, GoesToItsPoint) {
  draw("<path d='M0 0H10L20 1L30 0H40'/>");
  expect_near(top(drawn + "point = [\"10 mm\", \"30 mm\"]\n"),
              {{0.03, 0.031}, {0.02, 0.031}, {0.01, 0.03}, {0, 0.031}, {-0.01, 0.031}});
}

TEST_F(DrawnFace, RestsOnThePacking) {
  draw("<path d='M0 0H10L20 1L30 0H40'/>");
  const Scene scene = load(drawn + "point = [\"10 mm\", \"packing top\"]\n").scene;
  double lowest = 1;
  for (const Vec2& p : scene.tools[1].points) lowest = std::min(lowest, p.y());
  EXPECT_EQ(scene.tools[1].point.y(), 0.02);  // two rows of discs
  EXPECT_NEAR(lowest, 0.02, 1e-15);
}

// An arc of 90 degrees and radius 20 mm between its ends: all its points are on the circle.
TEST_F(DrawnFace, HasArcs) {
  draw("<path d='M0 -40A20 20 0 0 0 20 -60'/>");
  const std::vector<Vec2> points = top("file = \"face.svg\"\nnormal = [0, -1]\n");
  EXPECT_GT(points.size(), 60U);
  for (const Vec2& p : points) EXPECT_NEAR((p - Vec2(0, 0.06)).norm(), 0.02, 1e-9);
}

TEST_F(DrawnFace, IsThatOfItsLayer) {
  draw(
      "<g inkscape:label='die'><path id='a' d='M0 0V40'/></g>"
      "<g id='g1' inkscape:label='punch'><path id='b' d='M0 -32H10'/><path id='c' d='M10 -32H20'/>"
      "<path id='d' d='M40 -32H20'/></g>");
  const std::vector<Vec2> expected{{0.04, 0.032}, {0.02, 0.032}, {0.01, 0.032}, {0, 0.032}};
  expect_near(top(drawn + "layer = \"punch\"\n"), expected);
  expect_near(top(drawn + "layer = \"g1\"\n"), expected);
  EXPECT_THAT(fault(drawn + "layer = \"pnch\"\n"),
              HasSubstr("face.svg: there is no layer 'pnch', did you mean 'punch'?, allowed: "));
  EXPECT_THAT(fault(drawn), HasSubstr("4 lines whose ends do not meet"));
}

TEST_F(DrawnFace, KeepsACopyOfItsFile) {
  draw("<path d='M0 -32H40'/>");
  const LoadedScene loaded = load(drawn);
  ASSERT_EQ(loaded.inputs.size(), 1U);
  EXPECT_EQ(loaded.inputs[0].source, folder_ / "face.svg");
  EXPECT_THAT(loaded.text, HasSubstr("file = \"" + loaded.inputs[0].copy.string() + "\""));
}

TEST_F(DrawnFace, IsRefusedWithTheReason) {
  draw("<path d='M0 -32H40'/>");
  EXPECT_THAT(fault("file = \"face.svg\"\n"),
              HasSubstr("tool[1].normal: required key is missing: it says on which side"));
  EXPECT_THAT(fault(""),
              HasSubstr("tool[1].points: required key is missing, allowed: points in m"));
  EXPECT_THAT(fault(drawn + "points = [[\"0 mm\", \"30 mm\"], [\"40 mm\", \"30 mm\"]]\n"),
              HasSubstr("tool[1].file: has no effect together with points"));
  EXPECT_THAT(fault("points = [[\"40 mm\", \"30 mm\"], [\"0 mm\", \"30 mm\"]]\nnormal = [0, -1]\n"),
              HasSubstr("tool[1].normal: has no effect"));
  EXPECT_THAT(fault(drawn + "unit = \"mm\"\n"), HasSubstr("its width already has the unit mm"));
  EXPECT_THAT(fault("file = \"none.svg\"\nnormal = [0, -1]\n"), HasSubstr("none.svg: "));
  EXPECT_THAT(fault("file = \"face.csv\"\nnormal = [0, -1]\n"),
              HasSubstr("not a drawing by its file extension, allowed: .svg, .dxf"));
  draw("<path d='M0 0H40'/>", "");
  EXPECT_THAT(fault(drawn), HasSubstr("no unit, allowed: a width"));
  draw("<circle id='hole' r='9'/>");
  EXPECT_THAT(fault(drawn), HasSubstr("a closed outline (in 'hole'), allowed: one open line"));
  draw("");
  EXPECT_THAT(fault(drawn), HasSubstr("it contains no line"));
  draw("<path d='M0 0L40 -40V0L0 -40'/>");
  EXPECT_THAT(fault(drawn), HasSubstr("tool[1].file: the straight part from point"));
}

}  // namespace
}  // namespace pulvis
