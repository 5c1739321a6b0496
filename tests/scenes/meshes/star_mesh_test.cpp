// Meshes and contact curves of ellipses, superellipses, polygons, traced and irregular outlines, over a range of shapes.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <string>

#include "scenes/meshes/mesh.hpp"
#include "scenes/meshes/mesh_size.hpp"
#include "scenes/outlines/outline.hpp"
#include "tests/scenes/meshes/shape_measures.hpp"

namespace pulvis {
namespace {

using std::numbers::pi;

struct Case {
  std::string name;
  Outline outline;
  int edges, rings = 1;
};

Shape meshed(const Outline& outline, int edges, int rings = 1) {
  return make_shape({"star", 0, outline, StarMesh{edges, rings}, false, 0, {}});
}
Shape meshed(const Case& c) { return meshed(c.outline, c.edges, c.rings); }

PolygonOutline regular(int sides, double rounding = 0) {
  return {sides, 10e-3, {}, rounding * 1e-3, false};
}
PolygonOutline polygon(std::vector<Vec2> corners_in_mm, double rounding, bool mirrored = false) {
  for (Vec2& corner : corners_in_mm) corner *= 1e-3;
  return {0, 0, std::move(corners_in_mm), rounding * 1e-3, mirrored};
}

// A grain of 10 mm with bumps and hollows; a wave has three lengths of its own, so that it has no symmetry.
PointsOutline grain(int points, bool mirrored = false) {
  PointsOutline outline;
  for (int i = 0; i < points; ++i) {
    const double a = 2 * pi * i / points;
    const double r = 5e-3 * (1 + 0.12 * std::cos(2 * a + 0.5) + 0.08 * std::cos(3 * a + 1) +
                             0.05 * std::cos(5 * a + 2));
    outline.points.emplace_back(r * std::cos(a), r * std::sin(a));
  }
  outline.mirrored = mirrored;
  return outline;
}

FourierOutline irregular(std::uint64_t variant) {
  FourierOutline outline;
  outline.diameter = 10e-3;
  outline.aspect_ratio = 1.4;
  outline.irregularity = 0.07;
  outline.variant = variant;
  return outline;
}

const std::vector<Vec2> five{{0, 0}, {8, -1}, {10, 4}, {6, 9}, {-1, 6}};
const std::vector<Vec2> notched{{0, 0}, {10, 0}, {10, 9}, {5, 5.5}, {0, 9}};
const std::vector<Vec2> angle{{0, 0}, {10, 0}, {10, 5}, {5, 5}, {5, 10}, {0, 10}};

std::vector<Case> cases() {
  std::vector<Case> list;
  for (const double ratio : {1.0, 1.5, 3.0, 6.0})
    for (const int edges : {32, 48, 96})
      list.push_back({"ellipse 1:" + std::to_string(ratio), EllipseOutline{12e-3, 12e-3 / ratio},
                      edges, edges / 48 + 1});
  for (const double exponent : {1.5, 2.5, 4.0, 8.0, 20.0})
    list.push_back({"superellipse " + std::to_string(exponent),
                    SuperellipseOutline{12e-3, 9e-3, exponent}, 64});
  for (const int sides : {3, 4, 5, 6, 8, 12})
    for (const double rounding : {0.0, 1.0})
      list.push_back({std::to_string(sides) + "-gon, rounding " + std::to_string(rounding),
                      regular(sides, rounding), 64});
  list.push_back({"five corners", polygon(five, 0), 40});
  list.push_back({"five corners, rounded", polygon(five, 1), 48});
  list.push_back({"notched", polygon(notched, 0.8), 64});
  list.push_back({"angle", polygon(angle, 1), 64});
  list.push_back({"grain", grain(60), 48});
  list.push_back({"fine grain", grain(60), 160, 4});
  for (const std::uint64_t variant : {1, 2, 3, 4})
    list.push_back({"irregular " + std::to_string(variant), irregular(variant), 64});
  return list;
}

struct MeshedCase : Case {
  Shape shape;
};
const std::vector<MeshedCase>& meshed_cases() {
  static const std::vector<MeshedCase> all = [] {
    std::vector<MeshedCase> list;
    for (const Case& c : cases()) list.push_back({c, meshed(c)});
    return list;
  }();
  return all;
}

TEST(StarMesh, EveryElementIsWellShaped) {
  double worst = 1;
  for (const MeshedCase& c : meshed_cases()) {
    const Shape& shape = c.shape;
    EXPECT_EQ(shape.boundary_nodes, c.edges) << c.name;
    EXPECT_GT(min_determinant(shape), 0) << c.name;
    EXPECT_GT(min_corner_sine(shape), 0.35) << c.name;
    worst = std::min(worst, min_corner_sine(shape));
  }
  RecordProperty("min_corner_sine", std::to_string(worst));
}

TEST(StarMesh, PolygonAndElementsHaveTheOutlinesArea) {
  for (const MeshedCase& c : meshed_cases()) {
    const Shape& shape = c.shape;
    EXPECT_NEAR(shape.area / outline_area(c.outline), 1, 1e-12) << c.name;
    EXPECT_NEAR(polygon_area(shape) / shape.area, 1, 1e-12) << c.name;
    EXPECT_NEAR(mesh_area(shape) / shape.area, 1, 1e-12) << c.name;
  }
}

struct Moments {
  double area = 0, x = 0, y = 0, polar = 0;
};

// Of the boundary polygon (Green).
Moments moments_of(const Shape& shape) {
  Moments m;
  for (int i = 0; i < shape.boundary_nodes; ++i) {
    const Point& p = shape.nodes[static_cast<std::size_t>(i)];
    const Point& q = shape.nodes[static_cast<std::size_t>((i + 1) % shape.boundary_nodes)];
    const double twice = p[0] * q[1] - p[1] * q[0];
    m.area += twice / 2;
    m.x += twice / 6 * (p[0] + q[0]);
    m.y += twice / 6 * (p[1] + q[1]);
    for (std::size_t k = 0; k < 2; ++k)
      m.polar += twice / 12 * (p[k] * p[k] + p[k] * q[k] + q[k] * q[k]);
  }
  return m;
}

TEST(StarMesh, HasItsCentreAtTheOrigin) {
  for (const MeshedCase& c : meshed_cases()) {
    const Shape& shape = c.shape;
    const Moments m = moments_of(shape);
    // The polygon stands for the outline to the fourth order of an edge; 2e-4 at 40 edges and a sharp turn.
    const double size = std::sqrt(shape.area);
    EXPECT_NEAR(m.x / m.area / size, 0, 5e-4) << c.name;
    EXPECT_NEAR(m.y / m.area / size, 0, 5e-4) << c.name;
  }
}

TEST(StarMesh, HasTheMomentOfInertiaOfTheOutline) {
  const auto error = [](int edges) {  // ellipse: pi/4 a b (a^2 + b^2)
    const double a = 6e-3, b = 3e-3;
    const Shape shape = meshed(EllipseOutline{2 * a, 2 * b}, edges);
    return std::abs(moments_of(shape).polar / (pi / 4 * a * b * (a * a + b * b)) - 1);
  };
  EXPECT_LT(error(48), 1e-4);
  EXPECT_GT(std::log2(error(64) / error(128)), 3.5);
  // Regular polygon with the radius R through its corners: A R^2 (2 + cos(2 pi / n)) / 6.
  const Shape hexagon = meshed(regular(6), 48);
  EXPECT_NEAR(moments_of(hexagon).polar / (hexagon.area * 25e-6 * 2.5 / 6), 1, 1e-12);
}

// How far the mirror images of nodes are from nodes.
double asymmetry(const Shape& shape, double sign_x, double sign_y) {
  double maximum = 0;
  for (const Point& p : shape.nodes) {
    double nearest = 1;
    for (const Point& q : shape.nodes)
      nearest = std::min(nearest, std::hypot(q[0] - sign_x * p[0], q[1] - sign_y * p[1]));
    maximum = std::max(maximum, nearest);
  }
  return maximum / std::sqrt(shape.area);
}

TEST(StarMesh, IsAsSymmetricAsItsOutline) {
  for (const Case& c : {Case{"ellipse", EllipseOutline{12e-3, 6e-3}, 48},
                        {"slender", EllipseOutline{12e-3, 3e-3}, 48},
                        {"superellipse", SuperellipseOutline{12e-3, 9e-3, 4}, 64},
                        {"hexagon", regular(6, 1), 48}}) {
    const Shape shape = meshed(c);
    EXPECT_LT(asymmetry(shape, -1, 1), 1e-10) << c.name;
    EXPECT_LT(asymmetry(shape, 1, -1), 1e-10) << c.name;
  }
  EXPECT_LT(asymmetry(meshed(regular(5), 40), -1, 1), 1e-10);
  EXPECT_LT(asymmetry(meshed(regular(3), 48), -1, 1), 1e-10);
}

// Distance of the contact curve from the ellipse, to first order, in half heights.
double curve_error(const EllipseOutline& o, int edges) {
  const double a = o.width / 2, b = o.height / 2;
  const Shape shape = meshed(o, edges);
  double maximum = 0;
  for (const Shape::Edge& edge : shape.edges)
    for (int i = 0; i < 16; ++i) {
      const Point p = curve_point(shape, edge, i / 16.0);
      const double x = p[0] / a, y = p[1] / b;
      const double slope = 2 * std::hypot(x / a, y / b);
      maximum = std::max(maximum, std::abs(x * x + y * y - 1) / slope / b);
    }
  return maximum;
}

TEST(StarCurve, OfAnEllipseIsTheEllipseToTheFourthOrder) {
  const EllipseOutline ellipse{12e-3, 6e-3};
  EXPECT_LT(curve_error(ellipse, 48), 7e-4);
  EXPECT_GT(std::log2(curve_error(ellipse, 48) / curve_error(ellipse, 96)), 3.3);
  EXPECT_LT(curve_error(EllipseOutline{12e-3, 3e-3}, 64), 1e-3);
}

// Of any outline: from a polygon that is far closer to it than the curve is.
double distance_to(const std::vector<Vec2>& polygon, const Point& point) {
  const Vec2 p(point[0], point[1]);
  double minimum = 1;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 &a = polygon[i], along = polygon[(i + 1) % polygon.size()] - a;
    const double share = std::clamp((p - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
    minimum = std::min(minimum, (p - a - share * along).norm());
  }
  return minimum;
}

double largest_distance(const Outline& outline, const Shape& shape) {
  const auto polygon = outline_polygon(outline, 1e-6 * std::sqrt(shape.area));
  double maximum = 0;
  for (const Shape::Edge& edge : shape.edges)
    for (int i = 0; i < 8; ++i)
      maximum = std::max(maximum, distance_to(polygon, curve_point(shape, edge, i / 8.0)));
  return maximum / std::sqrt(shape.area);
}

TEST(StarCurve, FollowsEveryOutline) {
  double worst = 0;
  for (const MeshedCase& c : meshed_cases()) {
    const double error = largest_distance(c.outline, c.shape);
    EXPECT_LT(error, 2.5e-3) << c.name;
    worst = std::max(worst, error);
  }
  RecordProperty("worst", std::to_string(worst));
}

TEST(StarCurve, ConvergesToATracedOutline) {
  const PointsOutline outline = grain(60);
  const double coarse = largest_distance(outline, meshed(outline, 48));
  const double fine = largest_distance(outline, meshed(outline, 96));
  EXPECT_GT(coarse / fine, 6);
}

TEST(StarCurve, OfASharpPolygonLiesOnItsSidesAndEndsInItsCorners) {
  for (const Outline& outline :
       {Outline(regular(3)), Outline(regular(6)), Outline(polygon(five, 0))}) {
    const Shape shape = meshed(outline, 40);
    EXPECT_LT(largest_distance(outline, shape), 1e-14);
    int ends = 0;
    for (const Shape::Edge& edge : shape.edges) ends += edge.next == Shape::no_edge;
    EXPECT_EQ(static_cast<std::size_t>(ends), outline_polygon(outline, 1e-6).size());
  }
}

TEST(StarCurve, HasTheOutlinesAreaAndLoadsTheNodesAsElementEdgesDo) {
  double worst = 0;
  for (const MeshedCase& c : meshed_cases()) {
    const Shape& shape = c.shape;
    double twice = 0, maximum = 0;
    const auto load = pressure_loads(shape);
    for (std::size_t i = 0; i < load.size(); ++i) {
      twice += shape.nodes[i][0] * load[i].curve[0] + shape.nodes[i][1] * load[i].curve[1];
      maximum = std::max(maximum, std::hypot(load[i].curve[0] - load[i].polygon[0],
                                             load[i].curve[1] - load[i].polygon[1]) /
                                      std::hypot(load[i].polygon[0], load[i].polygon[1]));
    }
    EXPECT_NEAR(0.5 * twice / shape.area, 1, 1e-3) << c.name;
    EXPECT_LT(maximum, 0.06) << c.name;  // 5% where a rounded rectangle's edges grow fastest
    worst = std::max(worst, maximum);
  }
  RecordProperty("worst", std::to_string(worst));
}

TEST(StarMesh, AMirroredOutlineHasTheMirroredMesh) {
  const std::vector<Outline> straight{polygon(five, 1), grain(60)};
  const std::vector<Outline> mirrored{polygon(five, 1, true), grain(60, true)};
  for (std::size_t i = 0; i < straight.size(); ++i) {
    const Shape a = meshed(straight[i], 48), b = meshed(mirrored[i], 48);
    EXPECT_NEAR(a.area / b.area, 1, 1e-12);
    const auto polygon = outline_polygon(mirrored[i], 1e-9);
    for (const Vec2& p : outline_polygon(straight[i], 1e-6))
      EXPECT_LT(distance_to(polygon, {-p.x(), p.y()}), 2e-9);
    EXPECT_NEAR(min_corner_sine(a), min_corner_sine(b), 1e-10);
  }
}

using Map = std::function<Vec2(const Vec2&)>;

// Of rounded polygons and of traced outlines: all lengths times `factor`, all points mapped.
Outline mapped(Outline outline, double factor, const Map& map) {
  if (auto* polygon = std::get_if<PolygonOutline>(&outline)) {
    for (Vec2& corner : polygon->corners) corner = map(factor * corner);
    polygon->rounding *= factor;
  } else {
    for (Vec2& point : std::get<PointsOutline>(outline).points) point = map(factor * point);
  }
  return outline;
}

// The largest distance of the mapped nodes of a mesh from those of the other one, over its size.
double disagreement(const Shape& shape, const Shape& other, double factor, const Map& map) {
  if (shape.nodes.size() != other.nodes.size()) return 1;
  double maximum = 0;
  for (const Point& p : shape.nodes) {
    const Vec2 wanted = map(factor * Vec2(p[0], p[1]));
    double nearest = std::numeric_limits<double>::max();
    for (const Point& q : other.nodes)
      nearest = std::min(nearest, std::hypot(q[0] - wanted.x(), q[1] - wanted.y()));
    maximum = std::max(maximum, nearest);
  }
  return maximum / std::sqrt(other.area);
}

TEST(StarMesh, AScaledMirroredOrTurnedOutlineHasThatMeshToRoundOff) {
  const Map same = [](const Vec2& p) { return p; };
  const Map mirrored = [](const Vec2& p) { return Vec2(-p.x(), p.y()); };
  const Map turned = [](const Vec2& p) {
    const double c = std::cos(0.7), s = std::sin(0.7);
    return Vec2(c * p.x() - s * p.y(), s * p.x() + c * p.y());
  };
  const std::vector<Vec2> six{{0, 0}, {6, -2}, {11, 1}, {10, 6}, {5, 9}, {-1, 5}};
  for (const Case& c : {Case{"five", polygon(five, 1), 24},
                        {"five", polygon(five, 1), 96},
                        {"five, two rings", polygon(five, 1), 80, 2},
                        {"six", polygon(six, 1.5), 40},
                        {"six", polygon(six, 1.5), 64},
                        {"notched", polygon(notched, 0.8), 64},
                        {"angle", polygon(angle, 1), 64},
                        {"sharp", polygon(five, 0), 40},
                        {"grain", grain(60), 48}}) {
    const Shape shape = meshed(c);
    for (const auto& [factor, map] :
         {std::pair{1.0 / 3, same}, {1e-3, same}, {1.0, mirrored}, {1.0, turned}}) {
      const Shape other = meshed(mapped(c.outline, factor, map), c.edges, c.rings);
      EXPECT_LT(disagreement(shape, other, factor, map), 1e-10) << c.name << ' ' << c.edges;
    }
  }
}

TEST(MeshSize, GivesEdgesOfThatLengthForEveryOutline) {
  const double size = 0.4e-3;
  for (ParticleSpec particle :
       {ParticleSpec{"disc", 0, DiscOutline{10e-3}, DiscMesh{}, false, 0, {}},
        {"rounded",
         0,
         RoundedRectangleOutline{12e-3, 8e-3, 3e-3},
         RoundedRectangleMesh{},
         false,
         0,
         {}},
        {"ring", 0, RingOutline{10e-3, 6e-3}, RingMesh{}, false, 0, {}},
        {"rectangle", 0, RectangleOutline{12e-3, 8e-3}, RectangleMesh{}, false, 0, {}},
        {"ellipse", 0, EllipseOutline{12e-3, 8e-3}, StarMesh{}, false, 0, {}},
        {"hexagon", 0, regular(6), StarMesh{}, false, 0, {}},
        {"grain", 0, grain(60), StarMesh{}, false, 0, {}},
        {"irregular", 0, irregular(1), StarMesh{}, false, 0, {}}}) {
    particle.mesh_size = size;
    mesh_of_size(particle);
    const Shape shape = make_shape(particle);
    double perimeter = 0;
    for (const Shape::Edge& edge : shape.edges) perimeter += edge.length;
    EXPECT_NEAR(perimeter / static_cast<double>(shape.edges.size()) / size, 1, 0.08) << shape.name;
    const double mean = std::sqrt(shape.area / shape.elements());
    EXPECT_NEAR(mean / size, 1, 0.25) << shape.name;
    EXPECT_GT(min_corner_sine(shape), 0.5) << shape.name;
  }
}

}  // namespace
}  // namespace pulvis
