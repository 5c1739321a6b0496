// Assembly: from the forces at contact points to those at control points, and from there to boundary nodes.
//
// Law      the sampled edge receives N_a(u_g) f_g, the other body -N_a(u*) f_g at the closest point, plus -N_a'(u*)
//          times the slope load where friction acts across a gap; nodes receive the transpose of y = S x
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "components/contact.hpp"
#include "components/shape.hpp"
#include "engine/lane_memory.hpp"
#include "systems/contact/contact_kernel.hpp"

namespace pulvis {

// x and y of the four control points of an edge, in memory order.
using ControlForce = Lane;

// N_a(u) for a = 0..3, each for x and for y, as polynomials in u.
struct EdgeBasis {
  ControlForce a, b, c, d;
  ControlForce value(double u) const { return fma(u, fma(u, fma(u, d, c), b), a); }
  ControlForce slope(double u) const { return fma(u, fma(3 * u, d, 2.0 * c), b); }
};
inline ControlForce of_control_points(double a, double b, double c, double d) {
  return ControlForce::load(std::array{a, a, b, b, c, c, d, d}.data());
}
inline const EdgeBasis& edge_basis() {
  static const EdgeBasis n{of_control_points(1.0 / 6, 2.0 / 3, 1.0 / 6, 0),
                           of_control_points(-0.5, 0, 0.5, 0), of_control_points(0.5, -1, 0.5, 0),
                           of_control_points(-1.0 / 6, 0.5, -0.5, 1.0 / 6)};
  return n;
}
using BasisByPoint = std::array<ControlForce, edge_points>;
inline const BasisByPoint& basis_by_point() {
  static const BasisByPoint by_point = [] {
    BasisByPoint n;
    for (std::size_t g = 0; g < edge_points; ++g) n[g] = edge_basis().value(kernels::edge_u[g]);
    return n;
  }();
  return by_point;
}

// Edges, by their first control point, that carry a force on some particle of the chunk. The others are skipped:
// their forces are zero, since to_nodes clears what it has read and nobody else writes them.
using LoadedEdges = std::vector<std::uint8_t>;

// What the edges of one particle carry.
struct EdgeForces {
  double* first;  // the particle's first edge
  LoadedEdges& loaded;

  double* on(int edge) const {
    entry(loaded, edge) = 1;
    return first + CurveForce::count * edge;
  }
};

// The force of a point on each control point, from a candidate's list: x y of every point.
inline ControlForce force_at(const double* point_force, int g) {
  return repeat_pair(point_force + 2 * g);
}

// Forces of four points on the control points of the edge they sample.
inline void add_sampled(const BasisByPoint& by_point, const double* point_force,
                        double* edge_force) {
  ControlForce sum = ControlForce::load(edge_force);
  for (int g = 0; g < edge_points; ++g)
    sum = fma(entry(by_point, g), force_at(point_force, g), sum);
  sum.store(edge_force);
}

// The opposite forces on the other body, at the closest point of each. `slope_load`: null without friction.
inline void add_other(const EdgeBasis& n, const PackedCurvePoint* closest, const double* f,
                      const double* slope_load, const EdgeForces& other) {
  std::array<int, edge_points> edge;
  std::array<ControlForce, edge_points> force;
  for (int g = 0; g < edge_points; ++g) {
    const CurvePoint at = closest[g].unpacked();
    entry(edge, g) = at.edge;
    ControlForce& on_edge = entry(force, g);
    on_edge = n.value(at.u) * force_at(f, g);
    if (slope_load != nullptr) on_edge = fma(n.slope(at.u), force_at(slope_load, g), on_edge);
  }
  const auto subtract = [&](int e, const ControlForce& sum) {
    double* out = other.on(e);
    (ControlForce::load(out) - sum).store(out);
  };
  // The points of an edge usually face one or two edges of the other body: no waiting for memory then.
  const int first = edge[0], last = edge[3];
  if ((edge[1] == first || edge[1] == last) && (edge[2] == first || edge[2] == last)) {
    ControlForce on_first = force[0], on_last = first == last ? ControlForce{} : force[3];
    if (first == last) on_first += force[3];
    for (std::size_t g = 1; g < 3; ++g) {
      const double share = edge[g] == first ? 1 : 0;
      on_first = fma(share, force[g], on_first);
      on_last = fma(1 - share, force[g], on_last);
    }
    subtract(first, on_first);
    if (last != first) subtract(last, on_last);
  } else {
    for (std::size_t g = 0; g < edge_points; ++g) subtract(edge[g], force[g]);
  }
}

// Forces from edges to boundary nodes, eight particles at once: four control points per edge, then the
// transpose of y = S x. `edge_force`: first edge of the first particle, `numbers` per particle.
template <class Nodes>
void to_nodes(const Shape& shape, double* edge_force, std::ptrdiff_t numbers,
              const LoadedEdges& loaded, const Nodes& node_force) {
  for (int node = 0; node < shape.boundary_nodes; ++node)
    node_force(Row<BoundaryNode>(node), 0) = node_force(Row<BoundaryNode>(node), 1) = Lane{};
  std::array<Lane, 8> sum{};  // x y of control points c ... c + 3, from the edges up to c
  int bear = 0;               // how many of these may carry a force
  for (int c = 0; c < shape.control_points(); ++c) {
    if (entry(loaded, c) != 0) {
      std::array<const double*, lane_count> rows;
      double* const first = edge_force + CurveForce::count * c;
      for (int l = 0; l < lane_count; ++l) entry(rows, l) = first + l * numbers;
      const auto of_edge = columns_of(rows);
      for (std::size_t k = 0; k < 8; ++k) sum[k] += of_edge[k];
      for (int l = 0; l < lane_count; ++l) Lane{}.store(first + l * numbers);
      bear = 4;
    }
    if (bear == 0) continue;
    --bear;
    for (const Shape::CurveTerm& term : shape.terms_of(c)) {
      node_force(term.node, 0) += term.weight * sum[0];
      node_force(term.node, 1) += term.weight * sum[1];
    }
    sum = {sum[2], sum[3], sum[4], sum[5], sum[6], sum[7], Lane{}, Lane{}};
  }
}

}  // namespace pulvis
