// Surfaces of tools in three dimensions for pictures: they look at the powder, meet where planes make a box, and go with
// their tools.
#include "scenes/results/solids/tool_sheets.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>
#include <string>

namespace pulvis::space {
namespace {

using Box = Eigen::AlignedBox3d;

const Box powder(Vec3(0, 0, 0), Vec3(2, 3, 4));

ToolSpec tool(ToolSpec::Shape shape, const Vec3& point, const Vec3& normal, double diameter = 0) {
  ToolSpec spec;
  spec.name = "tool";
  spec.shape = shape;
  spec.point = point;
  spec.normal = normal;
  spec.diameter = diameter;
  return spec;
}

struct Piece {
  std::vector<Vec3> corners;
  Vec3 middle() const { return (corners[0] + corners[1] + corners[2] + corners[3]) / 4; }
  Vec3 area() const { return 0.5 * (corners[2] - corners[0]).cross(corners[3] - corners[1]); }
};

std::vector<Piece> pieces_of(const Scene& scene, const Vec3& shift = Vec3::Zero()) {
  const ToolSheets sheets(scene, powder);
  std::vector<double> places;
  for (const ToolSpec& one : scene.tools)
    for (int k = 0; k < 3; ++k) places.push_back(one.point[k] + shift[k]);
  const std::vector<double> xyz = sheets.points(places);
  EXPECT_EQ(xyz.size(), 3 * sheets.faces().points);
  std::vector<Piece> pieces(sheets.faces().tool.size());
  for (std::size_t i = 0; i < sheets.faces().corners.size(); ++i)
    pieces[i / 4].corners.emplace_back(
        Vec3::Map(&xyz[3 * static_cast<std::size_t>(sheets.faces().corners[i])]));
  return pieces;
}

double area_of(const std::vector<Piece>& pieces) {
  double area = 0;
  for (const Piece& piece : pieces) area += piece.area().norm();
  return area;
}

Scene box_of_planes() {
  Scene scene;
  for (int k = 0; k < 3; ++k) {
    scene.tools.push_back(tool(ToolSpec::Shape::plane, powder.min(), Vec3::Unit(k)));
    scene.tools.push_back(tool(ToolSpec::Shape::plane, powder.max(), -Vec3::Unit(k)));
  }
  return scene;
}

TEST(ToolSheets, PlanesAroundThePowderCloseToABox) {
  const auto pieces = pieces_of(box_of_planes());
  ASSERT_EQ(pieces.size(), 6U);
  EXPECT_DOUBLE_EQ(area_of(pieces), 2 * (2 * 3 + 3 * 4 + 4 * 2));
  std::set<std::string> corners;
  for (const Piece& piece : pieces)
    for (const Vec3& c : piece.corners)
      corners.insert(std::to_string(c.x()) + std::to_string(c.y()) + std::to_string(c.z()));
  EXPECT_EQ(corners.size(), 8U);
}

TEST(ToolSheets, EveryPieceLooksAtThePowder) {
  Scene scene = box_of_planes();
  scene.tools.push_back(tool(ToolSpec::Shape::die, Vec3(1, 1.5, 0), -Vec3::UnitZ(), 8));
  scene.tools.push_back(tool(ToolSpec::Shape::punch, Vec3(1, 1.5, 9), -Vec3::UnitZ(), 4));
  scene.tools.back().profile = {{0, 0}, {1, 0.2}};
  for (const Piece& piece : pieces_of(scene)) {
    const bool is_rim = piece.middle().z() > 9;  // the punch's side looks outward
    const Vec3 to_powder = is_rim ? Vec3(piece.middle() - Vec3(1, 1.5, piece.middle().z()))
                                  : Vec3(powder.center() - piece.middle());
    EXPECT_GT(piece.area().dot(to_powder), 0) << piece.middle().transpose();
  }
}

// Frustums of the quarter circle with a radius of 0.5 about its edge: their area comes near that of the torus, and the ring
// of the face is as wide as a fifth of the hole.
TEST(ToolSheets, ADieEndsAtItsMouth) {
  Scene scene;
  scene.tools.push_back(tool(ToolSpec::Shape::die, Vec3(1, 1.5, 0), Vec3::UnitZ(), 8));
  scene.tools[0].height = 2;
  scene.tools[0].rounding = 0.5;
  double highest = -1, widest = 0, edge = 0;
  for (const Piece& piece : pieces_of(scene)) {
    for (const Vec3& corner : piece.corners) {
      highest = std::max(highest, corner.z());
      widest = std::max(widest, std::hypot(corner.x() - 1, corner.y() - 1.5));
      EXPECT_GE(std::hypot(corner.x() - 1, corner.y() - 1.5), 4 - 1e-12);
    }
    if (piece.middle().z() > 1.5 && piece.middle().z() < 2 - 1e-9) edge += piece.area().norm();
    const Vec3 inward = Vec3(1, 1.5, 10) - piece.middle();
    EXPECT_GT(piece.area().dot(inward), 0) << piece.middle().transpose();
  }
  EXPECT_DOUBLE_EQ(highest, 2);
  EXPECT_NEAR(widest, 4.5 + 0.2 * 8, 1e-12);
  const double pi = std::numbers::pi, torus = 0.5 * pi * (pi * 4.5 - 2 * 0.5);
  EXPECT_NEAR(edge, torus, 0.01 * torus);
}

TEST(ToolSheets, GoWithTheirTools) {
  const Scene scene = box_of_planes();
  const Vec3 shift(0.1, -0.2, 0.3);
  const auto before = pieces_of(scene), after = pieces_of(scene, shift);
  for (std::size_t i = 0; i < before.size(); ++i)
    EXPECT_LT((after[i].middle() - before[i].middle() - shift).norm(), 1e-12);
}

TEST(ToolSheets, APlaneAcrossADieIsADiscInIt) {
  Scene scene;
  scene.tools.push_back(tool(ToolSpec::Shape::plane, Vec3(7, 7, 0), Vec3::UnitZ()));
  scene.tools.push_back(tool(ToolSpec::Shape::die, Vec3(1, 1, 0), Vec3::UnitZ(), 4));
  const auto all = pieces_of(scene);
  const std::vector<Piece> disc(all.begin(), all.begin() + static_cast<long>(all.size() / 2));
  // 48 sectors: a polygon has sin(x)/x of the circle's area, x = 2 pi / 48.
  const double x = 2 * std::numbers::pi / 48;
  EXPECT_NEAR(area_of(disc), std::numbers::pi * 4 * std::sin(x) / x, 1e-12);
  for (const Piece& piece : disc)
    for (const Vec3& corner : piece.corners) EXPECT_LE((corner - Vec3(1, 1, 0)).norm(), 2 + 1e-12);
}

}  // namespace
}  // namespace pulvis::space
