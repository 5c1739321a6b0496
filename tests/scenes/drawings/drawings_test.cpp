// Outlines from SVG and DXF: by the area and the extent of known figures.
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>

#include "scenes/drawings/dxf_outline.hpp"
#include "scenes/drawings/svg_outline.hpp"
#include "tests/helpers/paths.hpp"
#include "tests/helpers/program.hpp"
#include "tests/helpers/wrong.hpp"

namespace pulvis {
namespace {

using drawing::BadDrawing;
using testing::HasSubstr;

constexpr double mm2 = 1e-6;

double area_of(const std::vector<Vec2>& points) {
  double twice = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec2 &a = points[i], &b = points[(i + 1) % points.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return std::abs(0.5 * twice);
}

// 200 units are 20 mm.
std::string svg_of(const std::string& inside) {
  return "<?xml version=\"1.0\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"20mm\" "
         "height=\"10mm\" viewBox=\"0 0 200 100\">" +
         inside + "</svg>";
}

std::vector<Vec2> outline_of(const std::string& inside) {
  return drawing::only_outline(drawing::chains_of_svg(svg_of(inside), ""));
}

struct Drawn {
  const char* name;
  const char* shape;
  double area;  // mm^2
};

void PrintTo(const Drawn& drawn, std::ostream* stream) { *stream << drawn.name; }

class SvgShapes : public testing::TestWithParam<Drawn> {};

TEST_P(SvgShapes, HaveTheirArea) {
  const std::vector<Vec2> points = outline_of(GetParam().shape);
  EXPECT_EQ(points.size(), 256U);
  EXPECT_NEAR(area_of(points) / mm2, GetParam().area, 1e-3 * GetParam().area);
}

INSTANTIATE_TEST_SUITE_P(
    All, SvgShapes,
    testing::Values(
        Drawn{"Circle", "<circle cx='50' cy='50' r='40'/>", 16 * std::numbers::pi},
        Drawn{"Arcs", "<path d='M100 50m-40,0a40,40 0 1,0 80,0a40,40 0 1,0-80,0z'/>",
              16 * std::numbers::pi},
        Drawn{"JoinedFlags", "<path d='M60 50a40 40 0 0180 0a40 40 0 01-80 0z'/>",
              16 * std::numbers::pi},
        Drawn{"TurnedArc", "<path d='M0 0A50 25 0 0 1 100 0A50 25 0 0 1 0 0'/>",
              12.5 * std::numbers::pi},
        Drawn{"Ellipse", "<ellipse rx='50' ry='25' transform='translate(9,9) rotate(30)'/>",
              12.5 * std::numbers::pi},
        Drawn{"Cubics",
              "<path d='M40 0C40 22.0914 22.0914 40 0 40S-40 22.0914-40 0-22.0914-40 0-40 40 "
              "-22.0914 40 0Z'/>",
              16 * std::numbers::pi},
        Drawn{"Quadratic", "<path d='M0 0Q50 100 100 0Z'/>", 100.0 / 3},
        Drawn{"SmoothQuadratic", "<path d='M0 0Q25 50 50 0T100 0L100-100H0Z'/>", 100},
        Drawn{"Relative", "<path d='M10 10h80v40H10z'/>", 32},
        Drawn{"Rectangle", "<rect x='3' y='4' width='80' height='40'/>", 32},
        Drawn{"Polygon", "<polygon points='0,0 80,0 80,40 0,40'/>", 32},
        Drawn{"Group", "<g transform='scale(2)'><g><rect width='40' height='20'/></g></g>", 32},
        Drawn{"Matrix", "<rect width='40' height='20' transform='matrix(2 0 0 2 5 5)'/>", 32},
        Drawn{"NotWhatIsDefined",
              "<defs><circle r='9'/></defs><rect width='80' height='40'/><text>x</text>", 32},
        Drawn{"InPieces", "<path d='M0 0H80V40'/><path d='M0 0V40H80'/>", 32}),
    [](const auto& tested) { return std::string(tested.param.name); });

TEST(SvgOutline, PointsUpwards) {
  for (const Vec2& point : outline_of("<circle cx='50' cy='60' r='40'/>")) {
    EXPECT_NEAR((point - Vec2(0.005, -0.006)).norm(), 0.004, 1e-6);
  }
}

TEST(SvgOutline, TakesAUnitWhereItHasNone) {
  const std::string text = "<svg><circle r='40'/></svg>";
  const auto points = drawing::only_outline(drawing::chains_of_svg(text, "um"));
  EXPECT_NEAR(area_of(points), 1600e-12 * std::numbers::pi, 1e-12);
}

std::string fault_of_svg(const std::string& inside) {
  return message_of<BadDrawing>([&] { outline_of(inside); });
}

TEST(SvgOutline, IsRefusedWithTheReason) {
  EXPECT_THAT(fault_of_svg("<path d='M0 0H10V10'/>"), HasSubstr("is open: it starts at"));
  EXPECT_THAT(fault_of_svg("<circle id='a' r='9'/><circle id='b' r='5'/>"),
              HasSubstr("2 closed outlines (in 'a', 'b'), allowed: one"));
  EXPECT_THAT(fault_of_svg("<circle r='9'/><path id='axis' d='M0 0H10'/>"),
              HasSubstr("open lines besides the outline (in 'axis')"));
  EXPECT_THAT(fault_of_svg("<path d='M0 0L10 10V0L0 10Z'/>"), HasSubstr("crosses itself near"));
  EXPECT_THAT(fault_of_svg("<path d='M0 0Lx'/>"), HasSubstr("a number is expected"));
  EXPECT_THAT(fault_of_svg("<path d='M0 0B1 1'/>"), HasSubstr("the command 'B'"));
  EXPECT_THAT(fault_of_svg("<path d='5 5'/>"), HasSubstr("does not start with a command"));
  EXPECT_THAT(fault_of_svg("<circle r='9' transform='skewX(3)'/>"),
              HasSubstr("the transform 'skewX'"));
  EXPECT_THAT(fault_of_svg(""), HasSubstr("it contains no outline"));
  for (const char* shape :
       {"<circle r='0'/>", "<circle r='1e300'/>", "<circle r='9' transform='scale(0)'/>"})
    EXPECT_THAT(fault_of_svg(shape), HasSubstr("m across, allowed: 1e-12 m to 1000 m")) << shape;
  const auto fault = [](const std::string& text, const std::string& unit) {
    return message_of<BadDrawing>([&] { drawing::chains_of_svg(text, unit); });
  };
  EXPECT_THAT(fault("<svg><circle r='1'/></svg>", ""), HasSubstr("no unit, allowed: a width"));
  EXPECT_THAT(fault(svg_of(""), "um"), HasSubstr("its width already has the unit mm"));
  EXPECT_THAT(fault("<html/>", "um"), HasSubstr("its root element is a different one"));
  EXPECT_THAT(fault("<svg", "um"), HasSubstr("not an SVG file"));
}

// By Inkscape's label or by id, of the group or the shape; whatever else is drawn does not matter.
TEST(SvgOutline, IsThatOfItsLayer) {
  const std::string text = svg_of(
      "<g inkscape:label='grain' id='layer1'><g transform='scale(2)'><rect id='r' width='40' "
      "height='20'/></g></g>"
      "<g id='frame'><rect rx='3' width='9' height='9'/><path d='M0 0H9'/></g>");
  for (const char* layer : {"grain", "layer1", "r"}) {
    const auto points = drawing::only_outline(drawing::chains_of_svg(text, "", layer));
    EXPECT_NEAR(area_of(points) / mm2, 32, 0.032) << layer;
  }
  EXPECT_THAT(
      message_of<BadDrawing>([&] { drawing::chains_of_svg(text, "", "grains"); }),
      HasSubstr(
          "there is no layer 'grains', did you mean 'grain'?, allowed: grain, layer1, r, frame"));
}

// Pieces with names of their own are one outline in their layer.
TEST(SvgOutline, IsJoinedInItsLayer) {
  const std::string text =
      svg_of("<g id='l'><path id='a' d='M0 0H80V40'/><path id='b' d='M0 0V40H80'/></g>");
  EXPECT_NEAR(area_of(drawing::only_outline(drawing::chains_of_svg(text, "", "l"))) / mm2, 32,
              0.032);
}

std::string test_file(const std::string& name) {
  std::ifstream file(paths::source_dir() + "/tests/scenes/drawings/" + name);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

// Written by ezdxf: two straight sides, and two half circles as bulges.
TEST(DxfOutline, HasBulges) {
  const auto points = drawing::only_outline(drawing::chains_of_dxf(test_file("slot.dxf"), ""));
  EXPECT_NEAR(area_of(points) / mm2, 60 + 9 * std::numbers::pi, 0.03);
  double right = 0;
  for (const Vec2& point : points) right = std::max(right, point.x());
  EXPECT_NEAR(right, 0.013, 1e-5);
}

// A spline, two lines and an arc, joined at their ends. The cubic of four points is a Bezier curve.
TEST(DxfOutline, IsJoinedFromPieces) {
  std::vector<Vec2> exact;
  for (int i = 0; i <= 1000; ++i) {
    const double t = i / 1000.0, u = 1 - t;
    exact.push_back(3 * u * u * t * Vec2(5, -3) + 3 * u * t * t * Vec2(10, 0) +
                    t * t * t * Vec2(12, 4));
  }
  for (int i = 0; i <= 1000; ++i) {
    const double angle = 0.5 * std::numbers::pi * (1 + i / 1000.0);
    exact.push_back(Vec2(2, 4) + 4 * Vec2(std::cos(angle), std::sin(angle)));
  }
  const auto points = drawing::only_outline(drawing::chains_of_dxf(test_file("mixed.dxf"), ""));
  EXPECT_NEAR(area_of(points) / mm2, area_of(exact), 5e-4 * area_of(exact));
}

std::string dxf_of(const std::string& entities, const std::string& header = "4") {
  return "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n" + header +
         "\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n" + entities + "0\nENDSEC\n0\nEOF\n";
}
const std::string circle = "0\nCIRCLE\n8\nA\n10\n1.0\n20\n2.0\n40\n3.0\n";

TEST(DxfOutline, IsACircle) {
  for (const auto& [unit, factor] : {std::pair{"4", 1e-3}, {"1", 0.0254}, {"13", 1e-6}}) {
    const auto points = drawing::only_outline(drawing::chains_of_dxf(dxf_of(circle, unit), ""));
    for (const Vec2& point : points)
      EXPECT_NEAR((point - factor * Vec2(1, 2)).norm(), 3 * factor, 1e-3 * factor);
  }
}

TEST(DxfOutline, IsThatOfItsLayer) {
  const std::string text =
      dxf_of(circle + "0\nCIRCLE\n8\nB\n10\n9\n20\n9\n40\n1\n" + "0\nELLIPSE\n8\nC\n");
  const auto of_layer = [&](const char* layer) {
    return area_of(drawing::only_outline(drawing::chains_of_dxf(text, "", layer))) / mm2;
  };
  EXPECT_NEAR(of_layer("A"), 9 * std::numbers::pi, 0.03);
  EXPECT_NEAR(of_layer("B"), std::numbers::pi, 0.003);
  EXPECT_THAT(message_of<BadDrawing>([&] { of_layer("D"); }),
              HasSubstr("there is no layer 'D', allowed: A, B, C"));
}

TEST(DxfOutline, IsRefusedWithTheReason) {
  const auto fault = [](const std::string& text, const std::string& unit = "") {
    return message_of<BadDrawing>(
        [&] { drawing::only_outline(drawing::chains_of_dxf(text, unit)); });
  };
  const std::string line = "0\nLINE\n8\nAXES\n10\n0\n20\n0\n11\n9\n21\n0\n";
  EXPECT_THAT(fault(dxf_of(circle + "0\nCIRCLE\n8\nB\n10\n9\n20\n9\n40\n1\n")),
              HasSubstr("2 closed outlines (in 'A', 'B')"));
  EXPECT_THAT(fault(dxf_of(line)), HasSubstr("the outline is open"));
  EXPECT_THAT(fault(dxf_of(circle + line)),
              HasSubstr("open lines besides the outline (in 'AXES')"));
  EXPECT_THAT(fault(dxf_of(circle, "0")), HasSubstr("no unit, allowed: $INSUNITS"));
  EXPECT_THAT(fault(dxf_of(circle), "um"), HasSubstr("its header already gives the unit"));
  EXPECT_THAT(fault(dxf_of("0\nELLIPSE\n8\n0\n")), HasSubstr("a ELLIPSE, allowed: LINE"));
  EXPECT_THAT(fault(dxf_of("0\nSPLINE\n8\n0\n71\n3\n")), HasSubstr("without control points"));
  EXPECT_THAT(fault("hello\nworld\n"), HasSubstr("not a DXF file: 'hello'"));
  EXPECT_THAT(fault(""), HasSubstr("without entities"));
}

}  // namespace
}  // namespace pulvis
