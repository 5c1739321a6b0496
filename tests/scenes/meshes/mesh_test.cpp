// Meshes of the outlines and their contact curves: geometry, areas, symmetry, loads.
#include "scenes/meshes/mesh.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "systems/contact/contact_kernel.hpp"
#include "tests/scenes/meshes/shape_measures.hpp"

namespace pulvis {
namespace {

struct DiscCase {
  int edges, rings;
  double refinement;
  bool coarse_core = false;
};
constexpr double radius = 5e-3;
constexpr double disc_area = std::numbers::pi * radius * radius;

Shape disc(const DiscCase& c, double phase = 0) {
  return make_shape({"disc",
                     0,
                     DiscOutline{2 * radius},
                     DiscMesh{c.edges, c.rings, c.refinement,
                              c.coarse_core ? DiscMesh::Core::coarse : DiscMesh::Core::even},
                     false,
                     0,
                     {}},
                    phase);
}
Shape plate(int columns, int rows, double width = 4e-3, double height = 1e-3) {
  return make_shape(
      {"plate", 0, RectangleOutline{width, height}, RectangleMesh{columns, rows}, false, 0, {}});
}

std::vector<DiscCase> disc_cases(std::initializer_list<double> refinements = {1, 8}) {
  std::vector<DiscCase> cases;
  for (const double refinement : refinements) {
    for (const int edges : {4, 8, 12, 16, 20, 40, 80, 160})
      for (const int rings : {1, 2, 3, 4}) cases.push_back({edges, rings, refinement});
    for (const int edges : {4, 8, 12, 16, 20}) cases.push_back({edges, 0, refinement});
  }
  for (const int edges : {12, 24, 48, 60, 96, 120})
    for (const int rings : {0, 1, 2}) cases.push_back({edges, rings, 1, true});
  return cases;
}
std::vector<Shape> plates() {
  return {plate(1, 1), plate(1, 3),  plate(2, 2),      plate(3, 2),
          plate(8, 8), plate(40, 5), plate(5, 5, 1, 1)};
}
std::string name_of(const DiscCase& c) {
  return std::to_string(c.edges) + " edges, " + std::to_string(c.rings) + " rings, refinement " +
         std::to_string(c.refinement) + (c.coarse_core ? ", coarse core" : "");
}

TEST(Mesh, EveryGaussPointHasAPositiveJacobian) {
  for (const DiscCase& c : disc_cases()) EXPECT_GT(min_determinant(disc(c)), 0) << name_of(c);
  for (const Shape& shape : plates()) EXPECT_GT(min_determinant(shape), 0);
}

TEST(Mesh, EveryCornerIsConvex) {  // stricter than the Jacobians at the Gauss points
  for (const DiscCase& c : disc_cases()) EXPECT_GT(min_corner_sine(disc(c)), 0.1) << name_of(c);
  for (const Shape& shape : plates()) EXPECT_DOUBLE_EQ(min_corner_sine(shape), 1);
}

TEST(Mesh, ACoarseCoreHasOneEdgeForThreeOfTheOutline) {
  const Shape shape = disc({60, 1, 1, true});
  EXPECT_EQ(shape.boundary_nodes, 60);
  EXPECT_EQ(shape.elements(), 5 * 5 + 4 * 20 + 60);
  EXPECT_EQ(shape.nodes.size(), 2U * 60 + 2 * 20 + 20 + 4 * 4);
  EXPECT_GT(min_corner_sine(shape), 0.29);  // 163 degrees, at the waist
}

TEST(Mesh, AreasOfPolygonNodesAndGaussPointsAreOne) {
  const auto expect_one_area = [](const Shape& shape, const std::string& name) {
    double nodal = 0;
    for (const double a : shape.nodal_area) {
      EXPECT_GT(a, 0);
      nodal += a;
    }
    // Sums of up to 4000 positive numbers: their round-off, 1e-16 each, adds up at worst.
    EXPECT_NEAR(nodal / mesh_area(shape), 1, 1e-13) << name;
    EXPECT_NEAR(polygon_area(shape) / mesh_area(shape), 1, 1e-12) << name;
  };
  for (const DiscCase& c : disc_cases()) expect_one_area(disc(c), name_of(c));
  for (const Shape& shape : plates()) expect_one_area(shape, "plate");
}

TEST(Mesh, DiscHasTheAreaOfItsCircle) {
  for (const DiscCase& c : disc_cases()) {
    const Shape shape = disc(c);
    EXPECT_DOUBLE_EQ(shape.area, disc_area);
    EXPECT_NEAR(polygon_area(shape) / disc_area, 1, 1e-12) << name_of(c);  // round-off of 160 terms
  }
}

TEST(Mesh, RefinedDiscIsFinerAtThePolesByItsRefinement) {
  for (const double refinement : {2.0, 8.0, 48.0}) {
    const Shape shape = disc({160, 1, refinement});
    double minimum = 1, maximum = 0;
    for (const Shape::Edge& edge : shape.edges) {
      minimum = std::min(minimum, edge.length);
      maximum = std::max(maximum, edge.length);
    }
    // A pole between two edges is half an edge finer than they; an edge of the flanks is one in 25.
    EXPECT_NEAR(maximum / minimum, refinement, 0.08 * refinement);
  }
}

TEST(Mesh, DiscWithoutRingsIsItsCore) {
  for (const int edges : {4, 8, 20}) {
    const Shape shape = disc({edges, 0, 1});
    EXPECT_EQ(shape.elements(), edges * edges / 16);
    EXPECT_EQ(shape.boundary_nodes, edges);
  }
}

TEST(Mesh, PhaseTurnsADiscAsAWhole) {
  const Shape still = disc({40, 1, 2}), turned = disc({40, 1, 2}, 0.4);
  for (std::size_t n = 0; n < still.nodes.size(); ++n) {
    const Point& p = still.nodes[n];
    EXPECT_NEAR(turned.nodes[n][0], std::cos(0.4) * p[0] - std::sin(0.4) * p[1], 1e-15 * radius);
    EXPECT_NEAR(turned.nodes[n][1], std::sin(0.4) * p[0] + std::cos(0.4) * p[1], 1e-15 * radius);
  }
}

bool has_node_at(const Shape& shape, double x, double y, double nodal_area) {
  for (std::size_t n = 0; n < shape.nodes.size(); ++n)
    // Coordinates come from sines and quarter turns: a few units of the last place of the radius.
    if (std::hypot(shape.nodes[n][0] - x, shape.nodes[n][1] - y) < 2e-15 * radius)
      return std::abs(shape.nodal_area[n] / nodal_area - 1) < 1e-12;
  return false;
}

TEST(Mesh, DiscHasTheSymmetryOfTheSquare) {
  for (const DiscCase& c : {DiscCase{8, 1, 1}, DiscCase{12, 2, 1}, DiscCase{40, 1, 1},
                            DiscCase{40, 3, 8}, DiscCase{20, 1, 8}}) {
    const Shape shape = disc(c);
    for (std::size_t n = 0; n < shape.nodes.size(); ++n) {
      const Point& p = shape.nodes[n];
      EXPECT_TRUE(has_node_at(shape, -p[0], p[1], shape.nodal_area[n]))
          << name_of(c) << ", node " << n;
      EXPECT_TRUE(has_node_at(shape, p[0], -p[1], shape.nodal_area[n]))
          << name_of(c) << ", node " << n;
      if (c.refinement == 1) {  // finer at the poles: only the rectangle's symmetry
        EXPECT_TRUE(has_node_at(shape, p[1], p[0], shape.nodal_area[n]))
            << name_of(c) << ", node " << n;
      }
    }
  }
}

// Largest distance of the contact curve from the circle, in radii.
double curve_error(const Shape& shape) {
  double maximum = 0;
  for (const Shape::Edge& edge : shape.edges)
    for (int i = 0; i <= 8; ++i) {
      const Point x = curve_point(shape, edge, i / 8.0);
      maximum = std::max(maximum, std::abs(std::hypot(x[0], x[1]) / radius - 1));
    }
  return maximum;
}

TEST(ContactCurve, OfADiscIsTheCircleToTheFourthOrder) {
  // Knots on the circle; between them a C2 cubic is off by theta^4/384 (theta: angle of an edge), and a
  // fifth more on the coarsest mesh. 1e-3 R at 8 edges, 6e-5 at 16, 2e-6 at 40, 6e-9 at 160.
  for (const int edges : {8, 12, 16, 20, 40, 80, 160}) {
    const double theta = 2 * std::numbers::pi / edges;
    EXPECT_LT(curve_error(disc({edges, 1, 1})), 1.2 * std::pow(theta, 4) / 384) << edges;
  }
  EXPECT_LT(curve_error(disc({4, 0, 1})), 0.03);  // theta is 1.6: 0.972 between the knots
  EXPECT_LT(curve_error(disc({16, 1, 1})), 1e-4);
  EXPECT_NEAR(std::log2(curve_error(disc({40, 1, 1})) / curve_error(disc({80, 1, 1}))), 4, 0.05);
}

TEST(ContactCurve, OfARefinedDiscIsTheCircleTo2em4OfItsRadius) {
  // The spline is uniform in its knots: where the growth of the edges stops it leaves the circle. 6e-4 at
  // 40 edges graded 8:1, where one edge more or less beside the flanks is felt, and less with more edges.
  EXPECT_LT(curve_error(disc({40, 1, 8})), 7e-4);
  EXPECT_LT(curve_error(disc({96, 1, 48})), 2e-4);
  EXPECT_LT(curve_error(disc({80, 1, 8})), 1e-4);
  EXPECT_LT(curve_error(disc({160, 1, 8})), 2e-5);
}

// Which side of a plate an edge of its curve lies on: 0 below, 1 right, 2 above, 3 left.
int side_of(int edge, int columns, int rows) {
  const int half = columns + rows;
  return edge / half * 2 + (edge % half >= columns ? 1 : 0);
}

TEST(ContactCurve, OfAPlateLiesOnItsSidesAndRunsEvenly) {
  for (const auto& [columns, rows] : {std::pair{1, 1}, {2, 1}, {3, 2}, {8, 5}}) {
    const Shape shape = plate(columns, rows);
    const double size[2] = {4e-3, 1e-3};
    for (int e = 0; e < static_cast<int>(shape.edges.size()); ++e) {
      const int side = side_of(e, columns, rows), along = side % 2, across = 1 - along;
      const double sign = side == 1 || side == 2 ? 1 : -1;
      const double length = size[along] / (along == 0 ? columns : rows);
      const auto& edge = shape.edges[static_cast<std::size_t>(e)];
      const Point first = shape.nodes[static_cast<std::size_t>(e)];
      EXPECT_NEAR(edge.length / length, 1, 1e-13);
      for (double u = 0; u <= 1; u += 0.125) {  // round-off of a millimetre: 1e-19
        const Point x = curve_point(shape, edge, u);
        const auto k = static_cast<std::size_t>(along), m = static_cast<std::size_t>(across);
        EXPECT_NEAR(x[m], sign * size[across] / 2, 4e-18);
        EXPECT_NEAR(x[k], first[k] + (side < 2 ? 1 : -1) * u * length, 4e-18);
      }
    }
  }
}

TEST(ContactCurve, GoesOnWhereItsEdgesSayAndEndsAtCorners) {
  for (const Shape& shape : {disc({20, 1, 4}), plate(3, 2)}) {
    int ends = 0;
    for (std::size_t e = 0; e < shape.edges.size(); ++e) {
      const Shape::Edge& edge = shape.edges[e];
      ends += edge.next == Shape::no_edge;
      if (edge.next == Shape::no_edge) continue;
      const Shape::Edge& next = shape.edges[static_cast<std::size_t>(edge.next)];
      EXPECT_EQ(next.previous, static_cast<int>(e));
      const Point here = curve_point(shape, edge, 1), there = curve_point(shape, next, 0);
      EXPECT_NEAR(std::hypot(here[0] - there[0], here[1] - there[1]), 0, 1e-15 * radius);
    }
    EXPECT_EQ(ends, shape.name == "disc" ? 0 : 4);
  }
}

TEST(ContactCurve, MovesWithItsNodesAsARigidBody) {
  for (const Shape& shape : {disc({8, 1, 1}), disc({40, 1, 8}), plate(1, 1), plate(5, 3)})
    for (int c = 0; c < shape.control_points(); ++c) {
      double sum = 0;
      for (std::int32_t t = shape.curve_begin[static_cast<std::size_t>(c)];
           t < shape.curve_begin[static_cast<std::size_t>(c) + 1]; ++t)
        sum += shape.curve_terms[static_cast<std::size_t>(t)].weight;
      EXPECT_NEAR(sum, 1, 1e-15);
    }
}

TEST(ContactCurve, UniformPressureLoadsTheNodesOfAFaceAsElementEdgesDo) {
  for (const int columns : {1, 2, 3, 4, 5, 8, 40}) {
    const Shape shape = plate(columns, 2);
    const auto load = nodal_loads(shape, 0, columns);
    for (int n = 0; n < shape.boundary_nodes; ++n) {
      const double share = n > columns ? 0 : n == 0 || n == columns ? 0.5 : 1;
      EXPECT_NEAR(load[static_cast<std::size_t>(n)], share, 1e-12)
          << columns << " edges, node " << n;
    }
  }
}

TEST(ContactCurve, UniformPressureLoadsAllNodesOfADiscAlike) {
  for (const int edges : {4, 8, 40})
    for (const double load : nodal_loads(disc({edges, 1, 1}), 0, edges))
      EXPECT_NEAR(load, 1, 1e-12);
}

TEST(ContactCurve, EdgesKnowTheirLengthAndTheElementBehind) {
  const Shape round = disc({40, 1, 1}), flat = plate(8, 4);
  double perimeter = 0;
  for (const Shape::Edge& edge : round.edges) perimeter += edge.length;
  EXPECT_NEAR(perimeter / (2 * std::numbers::pi * radius), 1,
              1e-5);                                      // the curve's own error, fourth order
  const double stiffness[2] = {1 / 0.25e-3, 1 / 0.5e-3};  // 1 / height, 1 / width of a quad
  for (int e = 0; e < 24; ++e)
    EXPECT_NEAR(flat.edges[static_cast<std::size_t>(e)].stiffness / stiffness[side_of(e, 8, 4) % 2],
                1, 1e-12);
  for (const Shape::Edge& edge : round.edges)
    EXPECT_NEAR(edge.weight[0] + edge.weight[1] + edge.weight[2] + edge.weight[3], edge.length,
                1e-18);
}

}  // namespace
}  // namespace pulvis
