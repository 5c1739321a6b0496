#include "scenes/meshes/contact_curve.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

#include "engine/portable_math.hpp"
#include "systems/contact/contact_kernel.hpp"

namespace pulvis {
namespace {

using Terms = std::map<int, double>;  // boundary node -> weight

void add(Terms& to, const Terms& from, double factor) {
  for (const auto& [node, weight] : from) to[node] += factor * weight;
}

Terms smoothed(int before, int at, int after, double c) {
  return {{before, -c}, {at, 1 + 2 * c}, {after, -c}};
}

void push_control_point(Shape& shape, const Terms& terms) {
  if (shape.curve_begin.empty()) shape.curve_begin.push_back(0);
  for (const auto& [node, weight] : terms)
    if (weight != 0) shape.curve_terms.push_back({Row<BoundaryNode>(node), weight});
  shape.curve_begin.push_back(static_cast<std::int32_t>(shape.curve_terms.size()));
}

// Smoothing of node `i` of a face with `edges` edges. Next to a corner 1/11 (1/10 when both
// neighbours are corners) instead of 1/12: solves "nodal loads of a uniform pressure are 1/2, 1, 1...".
double face_smoothing(int i, int edges) {
  if (i == 0 || i == edges) return 0;
  if (edges == 2) return 1.0 / 10;
  return i == 1 || i == edges - 1 ? 1.0 / 11 : 1.0 / 12;
}

void push_edge(Shape& shape, const Shape::Edge& edge) {
  shape.edge_from.resize(static_cast<std::size_t>(shape.control_points()), Shape::no_edge);
  shape.edge_from[static_cast<std::size_t>(edge.first_control)] =
      static_cast<std::int32_t>(shape.edges.size());
  shape.edges.push_back(edge);
}

void push_face(Shape& shape, int first, int edges, int boundary_nodes) {
  const auto node = [&](int i) { return (first + i) % boundary_nodes; };
  std::vector<Terms> y;
  for (int i = 0; i <= edges; ++i) {
    const double c = face_smoothing(i, edges);
    y.push_back(c > 0 ? smoothed(node(i - 1), node(i), node(i + 1), c) : Terms{{node(i), 1.0}});
  }
  // The spline ends in its end node without curvature: the control points beyond are mirror images.
  Terms before, after;
  add(before, y[0], 2);
  add(before, y[1], -1);
  add(after, y[y.size() - 1], 2);
  add(after, y[y.size() - 2], -1);

  const int first_control = shape.curve_begin.empty() ? 0 : shape.control_points();
  push_control_point(shape, before);
  for (const Terms& terms : y) push_control_point(shape, terms);
  push_control_point(shape, after);
  const int first_edge = static_cast<int>(shape.edges.size());
  for (int e = 0; e < edges; ++e) {
    Shape::Edge edge;
    edge.first_control = first_control + e;
    edge.previous = e > 0 ? first_edge + e - 1 : Shape::no_edge;
    edge.next = e + 1 < edges ? first_edge + e + 1 : Shape::no_edge;
    push_edge(shape, edge);
  }
}

Point node_of(const Shape& shape, int boundary_node) {
  return shape.nodes[static_cast<std::size_t>(boundary_node)];
}

}  // namespace

std::vector<std::size_t> elements_behind(const Shape& shape) {
  std::vector<std::size_t> behind(static_cast<std::size_t>(shape.boundary_nodes),
                                  shape.quads.size());
  for (std::size_t e = 0; e < shape.quads.size(); ++e)
    for (std::size_t k = 0; k < 4; ++k) {
      const int from = shape.quads[e][k].value, to = shape.quads[e][(k + 1) % 4].value;
      if (from < shape.boundary_nodes && to == (from + 1) % shape.boundary_nodes)
        behind[static_cast<std::size_t>(from)] = e;
    }
  if (std::ranges::find(behind, shape.quads.size()) != behind.end())
    throw std::logic_error("boundary edge without an element");
  return behind;
}

void close_curve(Shape& shape, const Smoothing& smoothing) {
  const int n = shape.boundary_nodes;
  for (int c = 0; c < n + 3; ++c) {
    const auto node = [&](int offset) { return (c + offset + 2 * n - 1) % n; };
    Terms y = smoothed(node(-1), node(0), node(1), smoothing.c[static_cast<std::size_t>(node(0))]);
    for (const auto& [offset, factor] : {std::pair{-2, 1}, {-1, -4}, {0, 6}, {1, -4}, {2, 1}})
      y[node(offset)] += factor * smoothing.d;  // with 4 nodes the first and the last are the same
    push_control_point(shape, y);
  }
  for (int e = 0; e < n; ++e) {
    Shape::Edge edge;
    edge.first_control = e;
    edge.previous = (e + n - 1) % n;
    edge.next = (e + 1) % n;
    push_edge(shape, edge);
  }
}

void cornered_curve(Shape& shape, const std::vector<int>& corners) {
  for (std::size_t f = 0; f < corners.size(); ++f) {
    const int end = f + 1 < corners.size() ? corners[f + 1] : shape.boundary_nodes;
    push_face(shape, corners[f], end - corners[f], shape.boundary_nodes);
  }
}

namespace {

// The nodes of the element's side that starts at boundary node i.
std::array<Row<Node>, 2> side_from(const Shape& shape, int i, std::size_t element) {
  const auto& quad = shape.quads[element];
  std::size_t c = 0;
  while (c < 3 && quad[c].value != i) ++c;
  return {quad[c], quad[(c + 1) % 4]};
}

}  // namespace

void measure_edges(Shape& shape) {
  std::vector<Point> control;
  for (int c = 0; c < shape.control_points(); ++c) {
    Point y{};
    for (std::int32_t t = shape.curve_begin[static_cast<std::size_t>(c)];
         t < shape.curve_begin[static_cast<std::size_t>(c) + 1]; ++t) {
      const Shape::CurveTerm& term = shape.curve_terms[static_cast<std::size_t>(t)];
      for (std::size_t k = 0; k < 2; ++k) y[k] += term.weight * node_of(shape, term.node.value)[k];
    }
    control.push_back(y);
  }
  const std::vector<std::size_t> behind = elements_behind(shape);
  double perimeter = 0;
  for (int i = 0; i < static_cast<int>(shape.edges.size()); ++i) {
    Shape::Edge& edge = shape.edges[static_cast<std::size_t>(i)];
    edge.length = 0;
    for (std::size_t g = 0; g < 4; ++g) {
      const auto slope = kernels::basis_slope(kernels::edge_u[g]);
      double tx = 0, ty = 0;
      for (std::size_t a = 0; a < 4; ++a) {
        tx += slope[a] * control[static_cast<std::size_t>(edge.first_control) + a][0];
        ty += slope[a] * control[static_cast<std::size_t>(edge.first_control) + a][1];
      }
      edge.weight[g] = kernels::edge_w[g] * portable::hypot(tx, ty);
      edge.length += edge.weight[g];
    }
    const std::size_t element = behind[static_cast<std::size_t>(i)];
    double area = 0;
    for (const Shape::GaussPoint& point : shape.gauss[element]) area += point.determinant;
    edge.stiffness = edge.length / area;
    edge.element = static_cast<int>(element);
    edge.ends = side_from(shape, i, element);
    shape.mean_edge_stiffness += edge.stiffness * edge.length;
    perimeter += edge.length;
  }
  shape.mean_edge_stiffness /= perimeter;
}

}  // namespace pulvis
