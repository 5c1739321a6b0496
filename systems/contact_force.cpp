// contact_force: gathers what every contact row does to a particle, as sampled and as other body, onto
// its control points, and from there onto its boundary nodes.
//
// Runs     after the narrow phase, before integrate
// Order    a particle sums its own rows in row order: the same bits for any number of threads
#include "systems/contact_row.hpp"
#include "systems/systems.hpp"

namespace pulvis {
namespace {

// N_a at each of the four Gauss points: a lane is a control point here.
std::array<Lane, 4> basis_by_point() {
  std::array<Lane, 4> by_point;
  for (std::size_t g = 0; g < 4; ++g) {
    const auto n = kernels::basis(kernels::edge_u[g]);
    by_point[g] = Lane{n[0], n[1], n[2], n[3]};
  }
  return by_point;
}

// Forces of a row's four points on the four control points of the sampled edge.
void add_sampled(const std::array<Lane, 4>& basis, const double* point_force,
                 double* control_force) {
  Lane x{}, y{};
  for (std::size_t g = 0; g < 4; ++g) {
    x += basis[g] * point_force[g];
    y += basis[g] * point_force[g + edge_points];
  }
  for (int a = 0; a < 4; ++a) {
    control_force[2 * a] += x[a];
    control_force[2 * a + 1] += y[a];
  }
}

// The opposite forces on the other body, at the closest point of each Gauss point.
void add_other(const Shape& shape, const double* closest, const double* f, const double* couple,
               double* control_force) {
  for (int g = 0; g < edge_points; ++g) {
    if (f[g] == 0 && f[g + edge_points] == 0) continue;  // this point is apart
    const int edge = static_cast<int>(closest[g]);
    const double u = closest[g] - edge;
    double* out = control_force + 2 * shape.edges[static_cast<std::size_t>(edge)].first_control;
    const auto n = kernels::basis(u);
    for (std::size_t a = 0; a < 4; ++a) {
      out[2 * a] -= n[a] * f[g];
      out[2 * a + 1] -= n[a] * f[g + edge_points];
    }
    if (couple == nullptr) continue;
    const auto slope = kernels::basis_slope(u);
    for (std::size_t a = 0; a < 4; ++a) {
      out[2 * a] -= slope[a] * couple[g];
      out[2 * a + 1] -= slope[a] * couple[g + edge_points];
    }
  }
}

// Control point forces to boundary nodes: the transpose of y = S x, four particles at once.
template <class Forces, class Nodes>
void to_nodes(const Shape& shape, const Forces& control_force, const Nodes& node_force) {
  const int n = shape.control_points();
  for (int node = 0; node < shape.boundary_nodes; ++node)
    node_force(Row<BoundaryNode>(node), 0) = node_force(Row<BoundaryNode>(node), 1) = Lane{};
  for (int c = 0; c < n; ++c) {
    Lane f[2];
    for (int k = 0; k < 2; ++k)
      f[k] =
          Lane{control_force(Row<ControlPoint>(c), k), control_force(Row<ControlPoint>(n + c), k),
               control_force(Row<ControlPoint>(2 * n + c), k),
               control_force(Row<ControlPoint>(3 * n + c), k)};
    for (std::int32_t t = shape.curve_begin[static_cast<std::size_t>(c)];
         t < shape.curve_begin[static_cast<std::size_t>(c) + 1]; ++t) {
      const Shape::CurveTerm& term = shape.curve_terms[static_cast<std::size_t>(t)];
      for (int k = 0; k < 2; ++k) node_force(term.node, k) += term.weight * f[k];
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
  static const std::array<Lane, 4> basis = basis_by_point();
  const Shape& shape = bodies->shape_of_chunk(chunk);
  const auto control = curve_force.chunk(chunk);
  for (int c = 0; c < 4 * shape.control_points(); ++c)
    control(Row<ControlPoint>(c), 0) = control(Row<ControlPoint>(c), 1) = 0;

  for (int lane = 0; lane < lane_count; ++lane) {
    const auto slot = static_cast<std::size_t>(4 * chunk.index + lane);
    double* own = &control(Row<ControlPoint>(lane * shape.control_points()));
    const auto edge = [&](std::int32_t e) {
      return own + 2 * shape.edges[static_cast<std::size_t>(e)].first_control;
    };
    if (pair) {
      for (int r = index->sampled_begin[slot]; r < index->sampled_begin[slot + 1]; ++r) {
        const Row<Contact> row(r);
        if ((*pair)(row, 3) != 0) add_sampled(basis, &(*point_force)(row), edge((*pair)(row, 1)));
      }
      for (int k = index->other_begin[slot]; k < index->other_begin[slot + 1]; ++k) {
        const Row<Contact> row(index->other_rows[static_cast<std::size_t>(k)]);
        if ((*pair)(row, 3) != 0)
          add_other(shape, &(*closest)(row), &(*point_force)(row),
                    couple ? &(*couple)(row) : nullptr, own);
      }
    }
    if (tool_pair) {
      for (int r = index->tool_begin[slot]; r < index->tool_begin[slot + 1]; ++r) {
        const Row<ToolContact> row(r);
        if ((*tool_pair)(row, 3) != 0)
          add_sampled(basis, &(*tool_force)(row), edge((*tool_pair)(row, 1)));
      }
    }
  }
  to_nodes(shape, control, node_force.chunk(chunk));
}

}  // namespace pulvis
