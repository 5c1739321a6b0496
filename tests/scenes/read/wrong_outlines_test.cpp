// Outlines and their files that are refused: where, why, and with which bound.
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "scenes/outlines/outline.hpp"
#include "tests/helpers/right_scene.hpp"

namespace pulvis {
namespace {

using testing::HasSubstr;

// The right scene, its grain (line 14 on) another outline; `file` is where a CSV lies beside it.
std::string with_grain(const std::string& outline) {
  std::string text = right_scene;
  const std::string from =
      "outline = \"disc\"\ndiameter = \"10 mm\"\n\n[particle.mesh]\nboundary_edges = 40\nrings = "
      "1\n";
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos);
  return text.replace(at, from.size(), outline + "\n");
}

void expect_refused(const std::string& outline, const std::string& key, const std::string& reason,
                    const std::string& bound) {
  const std::vector<SceneProblem> problems = problems_of(with_grain(outline));
  ASSERT_FALSE(problems.empty()) << outline;
  const SceneProblem& problem = problems.front();
  EXPECT_EQ(problem.key, "particle[0]" + key);
  EXPECT_GE(problem.line, 12) << problem.text();
  EXPECT_THAT(problem.message, HasSubstr(reason));
  EXPECT_THAT(problem.message, HasSubstr("allowed: "));
  EXPECT_THAT(problem.message, HasSubstr(bound));
}

std::string polygon(const std::string& corners, const std::string& more = "") {
  return "outline = \"polygon\"\ncorners = [" + corners + "]\n" + more;
}
const std::string square =
    R"(["0 mm", "0 mm"], ["9 mm", "0 mm"], ["9 mm", "9 mm"], ["0 mm", "9 mm"])";
const std::string hooked =
    R"(["0 mm","0 mm"],["10 mm","0 mm"],["10 mm","10 mm"],["0 mm","10 mm"],["0 mm","8 mm"],["8 mm","8 mm"],["8 mm","2 mm"],["0 mm","2 mm"])";

TEST(WrongOutline, PolygonIsRefusedWithReasonAndBound) {
  expect_refused(polygon(R"(["0 mm","0 mm"],["9 mm","9 mm"],["9 mm","0 mm"],["0 mm","9 mm"])"),
                 ".corners", "crosses itself: the side between corners 1 and 2",
                 "sides that meet only at their ends");
  expect_refused(polygon(R"(["0 mm", "0 mm"], ["9 mm", "0 mm"])"), ".corners", "2 corners",
                 "at least 3");
  expect_refused(polygon(square, "rounding = \"5 mm\""), ".rounding", "0.005 m is too large",
                 "0.0045 m");
  expect_refused(polygon(square, "diameter = \"5 mm\""), ".diameter", "no effect", "sides");
  expect_refused(polygon(square, "sides = 5\ndiameter = \"5 mm\""), ".corners", "already",
                 "either");
  expect_refused("outline = \"polygon\"", ".corners", "missing", "either sides and diameter");
  expect_refused("outline = \"polygon\"\nsides = 2\ndiameter = \"5 mm\"", ".sides", "2 is out of",
                 ">= 3");
  expect_refused(polygon(R"(["0 mm","0 mm"],["0 mm","0 mm"],["9 mm","0 mm"],["5 mm","9 mm"])"),
                 ".corners", "corners 1 and 2 are one point", "each once");
  expect_refused(
      polygon(
          R"(["0 mm","0 mm"],["10 mm","0 mm"],["10 mm","9 mm"],["5 mm","5 mm"],["0 mm","9 mm"])"),
      ".rounding", "(", "> 0 and <= ");
  expect_refused(polygon(hooked, "rounding = \"0.5 mm\""), ".corners", "no point inside",
                 "outlines, which have such a point");
}

TEST(WrongOutline, ExponentSlendernessAndMeshAreRefusedWithTheirBounds) {
  const std::string super = "outline = \"superellipse\"\nwidth = \"9 mm\"\nheight = \"9 mm\"\n";
  expect_refused(super + "exponent = 1.2", ".exponent", "1.2 is out of range", ">= 1.5 and <= 20");
  expect_refused(super + "exponent = 21", ".exponent", "21 is out of range", ">= 1.5 and <= 20");
  const std::string ellipse = "outline = \"ellipse\"\nwidth = \"9 mm\"\nheight = ";
  expect_refused(ellipse + "\"1 mm\"", ".height", "9 times the other", "at most 8 times");
  expect_refused(ellipse + "\"3 mm\"\n\n[particle.mesh]\nboundary_edges = 12",
                 ".mesh.boundary_edges", "12 edges are too few", ">= 20");
  expect_refused(ellipse + "\"6 mm\"\n\n[particle.mesh]\nrings = 0", ".mesh.rings", "needs a ring",
                 ">= 1");
  expect_refused(ellipse + "\"6 mm\"\n\n[particle.mesh]\nsize = \"1 mm\"\nrings = 1", ".mesh.rings",
                 "no effect together with size", "only one of them");
  expect_refused(ellipse + "\"6 mm\"\n\n[particle.mesh]\nsize = \"1 um\"", ".mesh", "quads",
                 "at most 1000000");
  expect_refused("outline = \"disc\"\ndiameter = \"9 mm\"\nmirrored = true", ".mirrored",
                 "no effect with outline = \"disc\"", "polygon");
  expect_refused(polygon(square, "mirrored = \"yes\""), ".mirrored", "wrong type", "true or false");
}

TEST(WrongOutline, IrregularIsRefusedWhereItWouldCrossItselfOrIsTooSharpForItsMesh) {
  const std::string grain = "outline = \"fourier\"\ndiameter = \"10 mm\"\n";
  const std::string coarse = "\n[particle.mesh]\nboundary_edges = 20";
  expect_refused(grain + "irregularity = 0.5\ndecay = 0", ".irregularity", "may cross itself",
                 "with these phases");
  expect_refused(grain + "roughness = 0.2\ndecay = 0\nmodes = 40", ".roughness", "may cross itself",
                 "with these phases");
  expect_refused(grain + "irregularity = 0.6", ".irregularity", "0.6 is out of range", "<= 0.5");
  expect_refused(grain + "aspect_ratio = 0.5", ".aspect_ratio", "0.5 is out of range", ">= 1");
  expect_refused(grain + "roughness = 0.02\nmodes = 7", ".modes", "7 is out of range", ">= 8");
  expect_refused(grain + "roughness = 0.02" + coarse, ".mesh.boundary_edges",
                 "20 edges are too few", ">= ");
  expect_refused("outline = \"fourier\"\n", ".diameter", "missing", "quantity");
}

class PointsFile : public testing::Test {
 protected:
  void write(const std::string& text) { std::ofstream(path_) << text; }
  std::string outline(const std::string& more = "") const {
    return "outline = \"points\"\nfile = \"" + path_.string() + "\"\n" + more;
  }
  // Points of a circle of radius 5, with its first line before them.
  static std::string circle(const std::string& header, int points = 40, double wave = 0) {
    std::string text = header;
    for (int i = 0; i < points; ++i) {
      const double a = 2 * std::numbers::pi * i / points, r = 5 + wave * (i % 2 == 0 ? 1 : -1);
      text += std::to_string(r * std::cos(a)) + ", " + std::to_string(r * std::sin(a)) + "\n";
    }
    return text;
  }
  Outline read(const std::string& more = "") const {
    return load_scene_text(with_grain(outline(more)), "points.toml", {"packing[0].spacing=10 mm"})
        .scene.particles[0]
        .outline;
  }

 private:
  std::filesystem::path path_ =
      std::filesystem::path(testing::TempDir()) /
      (std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + ".csv");
};

TEST_F(PointsFile, IsReadInTheUnitOfItsHeaderOrOfTheKey) {
  const double area = std::numbers::pi * 25;
  write(circle("x (mm), y (mm)\n"));
  EXPECT_NEAR(outline_area(read()) / (area * 1e-6), 1, 1e-4);
  write(circle("# traced by hand\nx [um]; y [um]\n"));
  EXPECT_NEAR(outline_area(read()) / (area * 1e-12), 1, 1e-4);
  write(circle(""));
  EXPECT_NEAR(outline_area(read("unit = \"mm\"")) / (area * 1e-6), 1, 1e-4);
}

TEST_F(PointsFile, IsScaledToWhatIsWanted) {
  write(circle("x (um), y (um)\n"));
  const double area = std::numbers::pi / 4 * 64e-6;
  EXPECT_NEAR(outline_area(read("diameter = \"8 mm\"")) / area, 1, 1e-12);
  EXPECT_NEAR(outline_area(read("area = \"50 mm^2\"")) / 50e-6, 1, 1e-12);
  EXPECT_NEAR(outline_area(read("width = \"8 mm\"")) / area, 1, 1e-4);
}

TEST_F(PointsFile, IsSmoothedByTheDistanceItSays) {
  write(circle("x (mm), y (mm)\n", 80, 0.05));
  const Outline rough = read("\n[particle.mesh]\nboundary_edges = 256"),
                smooth = read("smoothing = \"0.05 mm\"");
  // A zigzag of 0.05 mm either way is 0.05 mm in the root mean square: nothing of it is left.
  const auto roughness = [](const Outline& outline) {
    double minimum = 1, maximum = 0;
    for (const Vec2& p : outline_polygon(outline, 1e-6)) {
      minimum = std::min(minimum, p.norm());
      maximum = std::max(maximum, p.norm());
    }
    return maximum - minimum;
  };
  EXPECT_GT(roughness(rough), 0.09e-3);
  EXPECT_LT(roughness(smooth), 0.01e-3);
  EXPECT_NEAR(outline_area(smooth) / (std::numbers::pi * 25e-6), 1, 2e-3);
}

TEST_F(PointsFile, IsRefusedAtItsLine) {
  expect_refused("outline = \"points\"\nfile = \"nowhere.csv\"", ".file",
                 "nowhere.csv: there is no", "a file of points (CSV, SVG, DXF)");
  const auto wrong = [&](const std::string& text, const std::string& reason,
                         const std::string& bound, const std::string& more = "") {
    write(text);
    expect_refused(outline(more), ".file", reason, bound);
  };
  wrong(circle("x (mm), y (mm)\n", 7), "7 points", "at least 8");
  wrong("x (mm), y (mm)\n1, 2\n3, four\n", ".csv:3: 'four' is not a number", "x, y");
  wrong("x (mm), y (mm)\n1, 2, 3\n", ".csv:2: 3 columns", "two");
  wrong("x (mm), y (mm)\n1, 2\n1, 2\n", ".csv:3: the same point", "each once");
  wrong(circle("x (mm), y (mm)\n10, 0\n10.000000001, 0\n"), ".csv:2: the next point is closer",
        "1e-09 of the outline's diagonal");
  wrong("x (mm), y (mm)\n1e40, 2\n", ".csv:2: a point 1e+37 m away", "up to 1e+30 m");
  wrong("x (mm), y (um)\n1, 2\n", ".csv:1: x is in 'mm' and y in 'um'", "one unit");
  wrong("x (kg), y (kg)\n1, 2\n", ".csv:1: unit:", "a length");
  wrong(circle("x, y\n"), ".csv:1: no unit", "the key unit");
  wrong(circle("x (mm), y (mm)\n"), ".csv:1: the unit is already 'mm'", "no key unit",
        "unit = \"mm\"");
  wrong("x (mm), y (mm)\n0,0\n4,4\n8,0\n8,8\n4,5\n4,3\n0,8\n-2,4\n", "crosses itself",
        "meet only at their ends");
  write(circle("x (mm), y (mm)\n"));
  expect_refused(outline("smoothing = \"2 mm\""), ".smoothing", "would smooth the outline away",
                 "<= 0.0005 m");
  expect_refused(outline("width = \"1 mm\"\narea = \"1 mm^2\""), ".width", "scaled only once",
                 "one of");
}

}  // namespace
}  // namespace pulvis
