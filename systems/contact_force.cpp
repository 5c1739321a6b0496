// contact_force: gathers what every contact row does to a particle, as sampled and as other body, onto
// its control points, and from there onto its boundary nodes.
//
// Runs     after the narrow phase, before integrate
// Order    a particle sums its own rows in row order: the same bits for any number of threads
#include "systems/contact_row.hpp"
#include "systems/systems.hpp"

namespace pulvis {
namespace {

// x and y of four control points, as they lie in memory.
using ControlForce = Lane;

// N_a(u) for a = 0..3, each of them for x and for y, as polynomials of u.
struct Polynomial {
  ControlForce a, b, c, d;
  ControlForce value(double u) const { return fma(u, fma(u, fma(u, d, c), b), a); }
  ControlForce slope(double u) const { return fma(u, fma(3 * u, d, 2.0 * c), b); }
};
ControlForce of_control_points(double a, double b, double c, double d) {
  return ControlForce::load(std::array{a, a, b, b, c, c, d, d}.data());
}
const Polynomial& basis() {
  static const Polynomial n{of_control_points(1.0 / 6, 2.0 / 3, 1.0 / 6, 0),
                            of_control_points(-0.5, 0, 0.5, 0), of_control_points(0.5, -1, 0.5, 0),
                            of_control_points(-1.0 / 6, 0.5, -0.5, 1.0 / 6)};
  return n;
}
std::array<ControlForce, edge_points> basis_by_point() {
  std::array<ControlForce, edge_points> by_point;
  for (std::size_t g = 0; g < edge_points; ++g) by_point[g] = basis().value(kernels::edge_u[g]);
  return by_point;
}

// A force on all control points, from the row's list: x of its points, then y.
ControlForce force_at(const double* point_force, int g) {
  const double x = point_force[g], y = point_force[g + edge_points];
  return ControlForce::load(std::array{x, y, x, y, x, y, x, y}.data());
}

// Forces of a row's four points on the four control points of the sampled edge.
void add_sampled(const std::array<ControlForce, edge_points>& by_point, const double* point_force,
                 double* edge_force) {
  ControlForce sum = ControlForce::load(edge_force);
  for (int g = 0; g < edge_points; ++g)
    sum = fma(by_point[static_cast<std::size_t>(g)], force_at(point_force, g), sum);
  sum.store(edge_force);
}

// The opposite forces on the other body, at the closest point of each Gauss point. `edge_force`: of the
// body's first edge.
void add_other(const Polynomial& n, const Shape& shape, const double* closest, const double* f,
               const double* couple, double* edge_force) {
  for (int g = 0; g < edge_points; ++g) {
    if (f[g] == 0 && f[g + edge_points] == 0) continue;  // this point is apart
    const int edge = static_cast<int>(closest[g]);
    const double u = closest[g] - edge;
    double* out =
        edge_force + CurveForce::count * shape.edges[static_cast<std::size_t>(edge)].first_control;
    ControlForce sum = fma(-n.value(u), force_at(f, g), ControlForce::load(out));
    if (couple != nullptr) sum = fma(-n.slope(u), force_at(couple, g), sum);
    sum.store(out);
  }
}

// Force on control point c of a body: of the up to four edges that it is part of. `count`: of its points.
std::array<double, 2> control_force(const double* edge_force, int c, int count) {
  std::array<double, 2> f{};
  for (int a = std::max(0, c - count + 4); a <= std::min(c, 3); ++a)
    for (std::size_t k = 0; k < 2; ++k)
      f[k] += edge_force[CurveForce::count * (c - a) + 2 * a + static_cast<int>(k)];
  return f;
}

// Control point forces to boundary nodes: the transpose of y = S x, eight particles at once.
template <class Nodes>
void to_nodes(const Shape& shape, const double* edge_force, const Nodes& node_force) {
  const int n = shape.control_points();
  for (int node = 0; node < shape.boundary_nodes; ++node)
    node_force(Row<BoundaryNode>(node), 0) = node_force(Row<BoundaryNode>(node), 1) = Lane{};
  for (int c = 0; c < n; ++c) {
    std::array<std::array<double, lane_count>, 2> f;
    for (std::size_t l = 0; l < lane_count; ++l) {
      const auto one =
          control_force(edge_force + static_cast<std::ptrdiff_t>(l) * CurveForce::count * n, c, n);
      f[0][l] = one[0];
      f[1][l] = one[1];
    }
    const Lane x = Lane::load(f[0].data()), y = Lane::load(f[1].data());
    for (std::int32_t t = shape.curve_begin[static_cast<std::size_t>(c)];
         t < shape.curve_begin[static_cast<std::size_t>(c) + 1]; ++t) {
      const Shape::CurveTerm& term = shape.curve_terms[static_cast<std::size_t>(t)];
      node_force(term.node, 0) += term.weight * x;
      node_force(term.node, 1) += term.weight * y;
    }
  }
}

}  // namespace

[[gnu::flatten]] void contact_force(Chunk chunk, Read<Bodies> bodies, Read<ContactIndex> index,
                                    Optional<Read<ContactPair<Contact>>> pair,
                                    Optional<Read<PointForce<Contact>>> point_force,
                                    Optional<Read<ClosestPoint>> closest,
                                    Optional<Read<FrictionCouple>> couple,
                                    Optional<Read<ContactPair<ToolContact>>> tool_pair,
                                    Optional<Read<PointForce<ToolContact>>> tool_force,
                                    Write<CurveForce> curve_force, Write<ContactForce> node_force) {
  static const auto by_point = basis_by_point();
  const Polynomial& n = basis();
  const Shape& shape = bodies->shape_of_chunk(chunk);
  double* all = &curve_force.chunk(chunk)(Row<ControlPoint>(0));
  const int numbers = CurveForce::count * shape.control_points();  // of a particle
  std::fill(all, all + lane_count * numbers, 0.0);

  for (int lane = 0; lane < lane_count; ++lane) {
    const auto slot = static_cast<std::size_t>(lane_count * chunk.index + lane);
    double* own = all + lane * numbers;
    const auto edge = [&](std::int32_t e) {
      return own + CurveForce::count * shape.edges[static_cast<std::size_t>(e)].first_control;
    };
    if (pair) {
      for (int r = index->sampled_begin[slot]; r < index->sampled_begin[slot + 1]; ++r) {
        const Row<Contact> row(r);
        if ((*pair)(row, 3) != 0)
          add_sampled(by_point, &(*point_force)(row), edge((*pair)(row, 1)));
      }
      for (int k = index->other_begin[slot]; k < index->other_begin[slot + 1]; ++k) {
        const Row<Contact> row(index->other_rows[static_cast<std::size_t>(k)]);
        if ((*pair)(row, 3) != 0)
          add_other(n, shape, &(*closest)(row), &(*point_force)(row),
                    couple ? &(*couple)(row) : nullptr, own);
      }
    }
    if (tool_pair) {
      for (int r = index->tool_begin[slot]; r < index->tool_begin[slot + 1]; ++r) {
        const Row<ToolContact> row(r);
        if ((*tool_pair)(row, 3) != 0)
          add_sampled(by_point, &(*tool_force)(row), edge((*tool_pair)(row, 1)));
      }
    }
  }
  to_nodes(shape, all, node_force.chunk(chunk));
}

}  // namespace pulvis
