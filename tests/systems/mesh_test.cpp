// Meshes of the outlines and their contact curves: geometry, areas, symmetry, loads.
#include "scenes/mesh.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "systems/contact_kernel.hpp"

namespace pulvis {
namespace {

struct DiscCase {
  int edges, rings;
  double refinement;
};
constexpr double radius = 5e-3;
constexpr double disc_area = std::numbers::pi * radius * radius;

Shape disc(const DiscCase& c, double phase = 0) {
  return make_shape(
      {"disc", 0, DiscOutline{2 * radius}, DiscMesh{c.edges, c.rings, c.refinement}, false, 0, {}}, phase);
}
Shape plate(int columns, int rows, double width = 4e-3, double height = 1e-3) {
  return make_shape(
      {"plate", 0, RectangleOutline{width, height}, RectangleMesh{columns, rows}, false, 0, {}});
}

std::vector<DiscCase> disc_cases(std::initializer_list<double> refinements = {1, 8}) {
  std::vector<DiscCase> cases;
  for (const int edges : {8, 12, 16, 20, 40, 80, 160})
    for (const int rings : {1, 2, 3, 4})
      for (const double refinement : refinements) cases.push_back({edges, rings, refinement});
  return cases;
}
std::vector<Shape> plates() {
  return {plate(1, 1), plate(1, 3), plate(2, 2), plate(3, 2), plate(8, 8), plate(40, 5), plate(5, 5, 1, 1)};
}
std::string name_of(const DiscCase& c) {
  return std::to_string(c.edges) + " edges, " + std::to_string(c.rings) + " rings, refinement " +
         std::to_string(c.refinement);
}

double mesh_area(const Shape& shape) {
  double area = 0;
  for (const auto& element : shape.gauss)
    for (const Shape::GaussPoint& point : element) area += point.determinant;
  return area;
}

double polygon_area(const Shape& shape) {
  double twice = 0;
  for (int i = 0; i < shape.boundary_nodes; ++i) {
    const Point& p = shape.nodes[static_cast<std::size_t>(i)];
    const Point& q = shape.nodes[static_cast<std::size_t>((i + 1) % shape.boundary_nodes)];
    twice += p[0] * q[1] - p[1] * q[0];
  }
  return 0.5 * twice;
}

double least_determinant(const Shape& shape) {
  double least = 1e300;
  for (const auto& element : shape.gauss)
    for (const Shape::GaussPoint& point : element) least = std::min(least, point.determinant);
  return least;
}

TEST(Mesh, EveryGaussPointHasAPositiveJacobian) {
  for (const DiscCase& c : disc_cases()) EXPECT_GT(least_determinant(disc(c)), 0) << name_of(c);
  for (const Shape& shape : plates()) EXPECT_GT(least_determinant(shape), 0);
}

TEST(Mesh, EveryCornerIsConvex) {  // stricter than the Jacobians at the Gauss points
  for (const DiscCase& c : disc_cases()) EXPECT_GT(least_corner_sine(disc(c)), 0.1) << name_of(c);
  for (const Shape& shape : plates()) EXPECT_DOUBLE_EQ(least_corner_sine(shape), 1);
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
  for (const DiscCase& c : disc_cases({1.0, 8.0})) {
    const Shape shape = disc(c);
    EXPECT_DOUBLE_EQ(shape.area, disc_area);
    EXPECT_NEAR(polygon_area(shape) / disc_area, 1, 1e-9) << name_of(c);
  }
}

Point control_point(const Shape& shape, int c) {
  Point y{};
  for (std::int32_t t = shape.curve_begin[static_cast<std::size_t>(c)];
       t < shape.curve_begin[static_cast<std::size_t>(c) + 1]; ++t) {
    const Shape::CurveTerm& term = shape.curve_terms[static_cast<std::size_t>(t)];
    for (std::size_t k = 0; k < 2; ++k)
      y[k] += term.weight * shape.nodes[static_cast<std::size_t>(term.node.value)][k];
  }
  return y;
}

Point curve_point(const Shape& shape, const Shape::Edge& edge, double u) {
  const auto n = kernels::basis(u);
  Point x{};
  for (std::size_t a = 0; a < 4; ++a) {
    const Point y = control_point(shape, edge.first_control + static_cast<int>(a));
    for (std::size_t k = 0; k < 2; ++k) x[k] += n[a] * y[k];
  }
  return x;
}

// Largest distance of the contact curve from the circle, in radii.
double curve_error(const Shape& shape) {
  double most = 0;
  for (const Shape::Edge& edge : shape.edges)
    for (int i = 0; i <= 8; ++i) {
      const Point x = curve_point(shape, edge, i / 8.0);
      most = std::max(most, std::abs(std::hypot(x[0], x[1]) / radius - 1));
    }
  return most;
}

TEST(ContactCurve, OfADiscIsTheCircle) {
  for (const int edges : {8, 12, 16, 20, 40, 80, 160})
    for (double r : {1., 8.}) printf("%d %g: %g\n", edges, r, curve_error(disc({edges, 1, r})));
}

TEST(X, Y) {
  for (const DiscCase& c : disc_cases()) { const Shape s = disc(c); printf("%s sine %g det %g area %g\n", name_of(c).c_str(), least_corner_sine(s), least_determinant(s)/disc_area*s.elements()*4, polygon_area(s)/disc_area-1); }
}

}  // namespace
}  // namespace pulvis
