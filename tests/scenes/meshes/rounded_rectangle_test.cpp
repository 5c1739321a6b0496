// Rounded rectangles and rings: geometry of mesh and contact curve over a sweep of sizes and edges.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "scenes/meshes/mesh.hpp"
#include "scenes/meshes/mesh_rounded_rectangle.hpp"
#include "scenes/outlines/outline.hpp"
#include "tests/scenes/meshes/shape_measures.hpp"

namespace pulvis {
namespace {

using std::numbers::pi;

struct Case {
  RoundedRectangleOutline outline;
  RoundedRectangleMesh mesh;
  Shape shape;
  std::string name;
};

Case rounded(double width, double height, double radius, int edges, int rings = 1) {
  const RoundedRectangleOutline outline{width, height, radius};
  const RoundedRectangleMesh mesh{edges, rings};
  return {outline, mesh, make_shape({"rounded", 0, outline, mesh, false, 0, {}}),
          std::to_string(width) + " x " + std::to_string(height) + ", radius " +
              std::to_string(radius) + ", " + std::to_string(edges) + " edges, " +
              std::to_string(rings) + " rings"};
}

// Radius 5 to 50% of the shorter side, sides 1:1 to 6:1 either way, edges from the fewest allowed on.
std::vector<Case> sweep() {
  std::vector<Case> cases;
  for (const auto& [width, height] :
       {std::pair{1e-2, 1e-2}, {1.5e-2, 1e-2}, {1e-2, 2e-2}, {6e-2, 1e-2}})
    for (const double share : {0.05, 0.1, 0.2, 0.3, 0.4, 0.47, 0.499, 0.5}) {
      const RoundedRectangleOutline outline{width, height, share * std::min(width, height)};
      const int fewest = fewest_edges(outline);
      for (const int edges : {fewest, std::max(fewest, 48), std::max(fewest, 48) + 40})
        for (const int rings : {1, 3})
          cases.push_back(rounded(width, height, outline.radius, edges, rings));
    }
  return cases;
}
const std::vector<Case>& all() {
  static const std::vector<Case> cases = sweep();
  return cases;
}

TEST(RoundedRectangle, EveryCornerOfAnElementIsWellShaped) {
  double worst = 1;
  for (const Case& c : all()) {
    EXPECT_GT(min_determinant(c.shape), 0) << c.name;
    EXPECT_GT(min_corner_sine(c.shape), 0.5) << c.name;
    worst = std::min(worst, min_corner_sine(c.shape));
  }
  RecordProperty("min_corner_sine", std::to_string(worst));
}

TEST(RoundedRectangle, DefaultMeshHasAboutTwoHundredQuads) {
  for (const double share : {0.05, 0.2, 0.5}) {
    const Shape shape = make_shape({"r",
                                    0,
                                    RoundedRectangleOutline{1e-2, 1e-2, share * 1e-2},
                                    RoundedRectangleMesh{},
                                    false,
                                    0,
                                    {}});
    EXPECT_EQ(shape.elements(), 192);
  }
}

TEST(RoundedRectangle, PolygonAndElementsHaveTheOutlinesArea) {
  for (const Case& c : all()) {
    const double area =
        c.outline.width * c.outline.height - (4 - pi) * c.outline.radius * c.outline.radius;
    EXPECT_DOUBLE_EQ(c.shape.area, area);
    EXPECT_NEAR(polygon_area(c.shape) / area, 1, 1e-12) << c.name;
    EXPECT_NEAR(mesh_area(c.shape) / area, 1, 1e-12) << c.name;
  }
}

TEST(RoundedRectangle, IsItsOwnMirrorImage) {
  for (const Case& c : all())
    for (std::size_t n = 0; n < c.shape.nodes.size(); ++n) {
      const Point p = c.shape.nodes[n];
      for (const Point mirrored : {Point{-p[0], p[1]}, Point{p[0], -p[1]}}) {
        double nearest = 1;
        for (const Point& q : c.shape.nodes)
          nearest = std::min(nearest, std::hypot(q[0] - mirrored[0], q[1] - mirrored[1]));
        ASSERT_LT(nearest, 1e-14 * (c.outline.width + c.outline.height))
            << c.name << ", node " << n;
      }
    }
}

TEST(RoundedRectangle, EveryArcHasFourEdgesAndNeighboursDifferLittle) {
  for (const Case& c : all()) {
    double minimum = 1, maximum = 0, growth = 1;
    for (const Shape::Edge& edge : c.shape.edges) {
      const double next = c.shape.edges[static_cast<std::size_t>(edge.next)].length;
      growth = std::max({growth, next / edge.length, edge.length / next});
      minimum = std::min(minimum, edge.length);
      maximum = std::max(maximum, edge.length);
    }
    EXPECT_LT(growth, 1.02 * max_edge_growth) << c.name;  // lengths of the curve, not of its chords
    const double arc = pi / 2 * c.outline.radius;
    EXPECT_LT(minimum, 1.1 * arc / 4)
        << c.name;  // four edges an arc, with the rest of a short flat ...
    // ... and no edge is thinner than a quarter of an arc, or than an even division would make it.
    double perimeter = 0;
    for (const Shape::Edge& edge : c.shape.edges) perimeter += edge.length;
    EXPECT_GT(minimum, 0.8 * std::min(arc / 4, perimeter / c.mesh.boundary_edges)) << c.name;
  }
}

// Distance of a point from the outline, outwards.
double outside(const RoundedRectangleOutline& o, const Point& p) {
  const double x = std::abs(p[0]) - (o.width / 2 - o.radius);
  const double y = std::abs(p[1]) - (o.height / 2 - o.radius);
  return std::hypot(std::max(x, 0.0), std::max(y, 0.0)) + std::min(std::max(x, y), 0.0) - o.radius;
}

double corner_error(const Case& c) {
  double maximum = 0;
  for (const Shape::Edge& edge : c.shape.edges)
    for (int i = 0; i <= 16; ++i)
      maximum =
          std::max(maximum, std::abs(outside(c.outline, curve_point(c.shape, edge, i / 16.0))));
  return maximum;
}

TEST(RoundedRectangleCurve, FollowsTheOutlineToOnePercentOfTheRadius) {
  double worst = 0;
  for (const Case& c : all()) {
    const double error = corner_error(c) / c.outline.radius;
    EXPECT_LT(error, 0.01) << c.name;
    worst = std::max(worst, error);
  }
  RecordProperty("worst", std::to_string(worst));
}

TEST(RoundedRectangleCurve, ConvergesToTheOutline) {
  // Curvature jumps where an arc ends, so that a C2 curve is off by the square of the edge length.
  const double coarse = corner_error(rounded(1e-2, 1e-2, 2e-3, 48));
  const double fine = corner_error(rounded(1e-2, 1e-2, 2e-3, 192));
  EXPECT_GT(coarse / fine, 8);
}

TEST(RoundedRectangleCurve, IsFlatTwoEdgesFromTheCorners) {
  for (const Case& c : {rounded(1e-2, 1e-2, 5e-4, 64), rounded(2e-2, 1e-2, 1e-3, 80)}) {
    const double flat = c.outline.width / 2 - c.outline.radius;
    int looked = 0;
    for (std::size_t e = 0; e < c.shape.edges.size(); ++e) {
      const auto n = c.shape.nodes.data();
      const auto reach = [&](std::size_t k) {  // of node e - 3 + k
        return n[(e + c.shape.edges.size() - 3 + k) % c.shape.edges.size()];
      };
      bool inside = true;  // all of e - 3 .. e + 4 on the lower flat, ends not counted
      for (std::size_t k = 0; k < 8; ++k)
        inside = inside && std::abs(reach(k)[0]) < flat * (1 + 1e-12) && reach(k)[1] < 0;
      if (!inside) continue;
      ++looked;
      for (double u = 0; u <= 1; u += 0.125)
        EXPECT_NEAR(curve_point(c.shape, c.shape.edges[e], u)[1], -c.outline.height / 2,
                    4e-16 * c.outline.height);
    }
    EXPECT_GE(looked, 3) << c.name;
  }
}

TEST(RoundedRectangleCurve, HasTheOutlinesArea) {
  double coarsest = 0, worst = 0;
  for (const Case& c : all()) {
    double twice = 0;  // Green: sum of x . dA/dx is twice the area, which is quadratic in x
    const auto load = pressure_loads(c.shape);
    for (std::size_t i = 0; i < load.size(); ++i)
      twice += c.shape.nodes[i][0] * load[i].curve[0] + c.shape.nodes[i][1] * load[i].curve[1];
    const double error = std::abs(0.5 * twice / c.shape.area - 1);
    EXPECT_LT(error, c.mesh.boundary_edges < 48 ? 4e-4 : 1e-4) << c.name;
    (c.mesh.boundary_edges < 48 ? coarsest : worst) =
        std::max(c.mesh.boundary_edges < 48 ? coarsest : worst, error);
  }
  RecordProperty("fewer_than_48_edges", std::to_string(coarsest));
  RecordProperty("from_48_edges_on", std::to_string(worst));
}

// Largest difference of a node's load by a uniform pressure on the curve from that on its element edges.
double load_error(const Shape& shape) {
  double maximum = 0;
  for (const PressureLoad& load : pressure_loads(shape))
    maximum = std::max(
        maximum, std::hypot(load.curve[0] - load.polygon[0], load.curve[1] - load.polygon[1]) /
                     std::hypot(load.polygon[0], load.polygon[1]));
  return maximum;
}

TEST(RoundedRectangleCurve, UniformPressureLoadsTheNodesAsElementEdgesDo) {
  for (const Case& c : all())
    EXPECT_LT(load_error(c.shape), 0.05) << c.name;  // the steepest growth
  EXPECT_LT(load_error(rounded(1e-2, 1e-2, 5e-4, 48).shape), 0.02);
  EXPECT_LT(load_error(rounded(1e-2, 1e-2, 5e-4, 96).shape), 0.006);
  EXPECT_LT(load_error(rounded(1e-2, 1e-2, 2e-3, 48).shape), 0.01);
}

TEST(RoundedRectangle, WithTheLargestRadiusIsTheDisc) {
  const Case c = rounded(1e-2, 1e-2, 5e-3, 40);
  const Shape disc = make_shape({"disc", 0, DiscOutline{1e-2}, DiscMesh{40, 1, 1}, false, 0, {}});
  ASSERT_EQ(c.shape.nodes.size(), disc.nodes.size());
  for (std::size_t n = 0; n < disc.nodes.size(); ++n)
    for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(c.shape.nodes[n][k], disc.nodes[n][k], 1e-16);
}

// ---- rings -------------------------------------------------------------------------------------------

Shape ring(double hole, int edges, int rings, double phase = 0) {
  return make_shape({"ring", 0, RingOutline{1e-2, hole}, RingMesh{edges, rings}, false, 0, {}},
                    phase);
}

TEST(Ring, ElementsHaveTheAreaOfTheAnnulusForAnyEdges) {
  for (const double hole : {1e-4, 5e-3, 9e-3})
    for (const int edges : {8, 40, 120})
      for (const int rings : {1, 4}) {
        const Shape shape = ring(hole, edges, rings, 0.3);
        const double area = pi / 4 * (1e-4 - hole * hole);
        EXPECT_DOUBLE_EQ(shape.area, area);
        EXPECT_NEAR(mesh_area(shape) / area, 1, 1e-12);
        EXPECT_GT(min_determinant(shape), 0);
        EXPECT_GT(min_corner_sine(shape), 0.7);  // 8 edges: angles of 67.5 degrees
        EXPECT_EQ(shape.elements(), edges * rings);
      }
}

TEST(Ring, HasTheContactCurveOfTheDisc) {
  const Shape tube = ring(5e-3, 40, 4);
  const Shape disc = make_shape({"disc", 0, DiscOutline{1e-2}, DiscMesh{40, 1, 1}, false, 0, {}});
  ASSERT_EQ(tube.edges.size(), disc.edges.size());
  for (std::size_t e = 0; e < disc.edges.size(); ++e) {
    const Point p = curve_point(tube, tube.edges[e], 0.3),
                q = curve_point(disc, disc.edges[e], 0.3);
    EXPECT_NEAR(std::hypot(p[0] - q[0], p[1] - q[1]), 0, 1e-16);
    EXPECT_DOUBLE_EQ(tube.edges[e].length, disc.edges[e].length);
  }
}

}  // namespace
}  // namespace pulvis
