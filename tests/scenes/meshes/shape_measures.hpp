// Measures of a meshed shape and its contact curve, for tests.
#pragma once

#include <algorithm>
#include <vector>

#include "components/shape.hpp"
#include "systems/contact/contact_kernel.hpp"

namespace pulvis {

inline double mesh_area(const Shape& shape) {
  double area = 0;
  for (const auto& element : shape.gauss)
    for (const Shape::GaussPoint& point : element) area += point.determinant;
  return area;
}

inline double polygon_area(const Shape& shape) {
  double twice = 0;
  for (int i = 0; i < shape.boundary_nodes; ++i) {
    const Point& p = shape.nodes[static_cast<std::size_t>(i)];
    const Point& q = shape.nodes[static_cast<std::size_t>((i + 1) % shape.boundary_nodes)];
    twice += p[0] * q[1] - p[1] * q[0];
  }
  return 0.5 * twice;
}

inline double min_determinant(const Shape& shape) {
  double minimum = 1e300;
  for (const auto& element : shape.gauss)
    for (const Shape::GaussPoint& point : element) minimum = std::min(minimum, point.determinant);
  return minimum;
}

inline Point control_point(const Shape& shape, int c) {
  Point y{};
  for (std::int32_t t = shape.curve_begin[static_cast<std::size_t>(c)];
       t < shape.curve_begin[static_cast<std::size_t>(c) + 1]; ++t) {
    const Shape::CurveTerm& term = shape.curve_terms[static_cast<std::size_t>(t)];
    for (std::size_t k = 0; k < 2; ++k)
      y[k] += term.weight * shape.nodes[static_cast<std::size_t>(term.node.value)][k];
  }
  return y;
}

inline Point curve_point(const Shape& shape, const Shape::Edge& edge, double u) {
  const auto n = kernels::basis(u);
  Point x{};
  for (std::size_t a = 0; a < 4; ++a) {
    const Point y = control_point(shape, edge.first_control + static_cast<int>(a));
    for (std::size_t k = 0; k < 2; ++k) x[k] += n[a] * y[k];
  }
  return x;
}

// Loads of the boundary nodes by a unit pressure on the edges [begin, end), in edge lengths: S^T int N du.
inline std::vector<double> nodal_loads(const Shape& shape, int begin, int end) {
  std::vector<double> load(static_cast<std::size_t>(shape.boundary_nodes));
  for (int e = begin; e < end; ++e)
    for (std::size_t g = 0; g < 4; ++g) {
      const auto n = kernels::basis(kernels::edge_u[g]);
      for (std::size_t a = 0; a < 4; ++a) {
        const auto c =
            static_cast<std::size_t>(shape.edges[static_cast<std::size_t>(e)].first_control) + a;
        for (std::int32_t t = shape.curve_begin[c]; t < shape.curve_begin[c + 1]; ++t) {
          const Shape::CurveTerm& term = shape.curve_terms[static_cast<std::size_t>(t)];
          load[static_cast<std::size_t>(term.node.value)] +=
              kernels::edge_w[g] * n[a] * term.weight;
        }
      }
    }
  return load;
}

// Gradient of the area inside the contact curve over the boundary nodes: the loads of a uniform pressure on
// it, an outward normal's component each. `along` is the length of the polygon's own, the loads that the
// element edges would give.
struct PressureLoad {
  Point curve;    // of the contact curve
  Point polygon;  // of the element edges
};
inline std::vector<PressureLoad> pressure_loads(const Shape& shape) {
  const auto n = static_cast<std::size_t>(shape.boundary_nodes);
  std::vector<PressureLoad> load(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Point &p = shape.nodes[(i + n - 1) % n], &q = shape.nodes[(i + 1) % n];
    load[i].polygon = {0.5 * (q[1] - p[1]), -0.5 * (q[0] - p[0])};
  }
  for (const Shape::Edge& edge : shape.edges)
    for (std::size_t g = 0; g < 4; ++g) {
      const auto basis = kernels::basis(kernels::edge_u[g]);
      const auto slope = kernels::basis_slope(kernels::edge_u[g]);
      Point t{};
      for (std::size_t a = 0; a < 4; ++a)
        for (std::size_t k = 0; k < 2; ++k)
          t[k] += slope[a] * control_point(shape, edge.first_control + static_cast<int>(a))[k];
      for (std::size_t a = 0; a < 4; ++a) {
        const auto c = static_cast<std::size_t>(edge.first_control) + a;
        for (std::int32_t j = shape.curve_begin[c]; j < shape.curve_begin[c + 1]; ++j) {
          const Shape::CurveTerm& term = shape.curve_terms[static_cast<std::size_t>(j)];
          const double w = kernels::edge_w[g] * basis[a] * term.weight;
          load[static_cast<std::size_t>(term.node.value)].curve[0] += w * t[1];
          load[static_cast<std::size_t>(term.node.value)].curve[1] -= w * t[0];
        }
      }
    }
  return load;
}

}  // namespace pulvis
