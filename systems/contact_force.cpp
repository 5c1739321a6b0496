// contact_force: gathers what every contact row does to a particle, as sampled and as other body, onto
// its control points, and from there onto its boundary nodes.
//
// Runs     after the narrow phase, before integrate
// Order    a particle sums its own rows in row order: the same bits for any number of threads
#include "systems/contact_row.hpp"
#include "systems/systems.hpp"

namespace pulvis {
namespace {

// Forces of a row's four points on the four control points of the sampled edge.
void add_sampled(const double* point_force, double* control_force) {
  static const auto n = kernels::basis(Lane{kernels::edge_u[0], kernels::edge_u[1],
                                            kernels::edge_u[2], kernels::edge_u[3]});
  const Lane fx = lane_of(point_force), fy = lane_of(point_force + edge_points);
  for (std::size_t a = 0; a < 4; ++a) {
    control_force[2 * a] += sum(n[a] * fx);
    control_force[2 * a + 1] += sum(n[a] * fy);
  }
}

// The opposite forces on the other body, at the closest point of each Gauss point.
void add_other(const Shape& shape, const double* closest, const double* f, const double* couple,
               double* control_force) {
  for (int g = 0; g < edge_points; ++g) {
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
      f[k] = Lane{control_force(Row<ControlPoint>(c), k), control_force(Row<ControlPoint>(n + c), k),
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

void contact_force(Chunk chunk, Read<Bodies> bodies, Read<ContactIndex> index,
                   Optional<Read<ContactPair<Contact>>> pair,
                   Optional<Read<PointForce<Contact>>> point_force,
                   Optional<Read<ClosestPoint>> closest, Optional<Read<FrictionCouple>> couple,
                   Optional<Read<ContactPair<ToolContact>>> tool_pair,
                   Optional<Read<PointForce<ToolContact>>> tool_force, Write<CurveForce> curve_force,
                   Write<ContactForce> node_force) {
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
        if ((*pair)(row, 3) != 0) add_sampled(&(*point_force)(row), edge((*pair)(row, 1)));
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
          add_sampled(&(*tool_force)(row), edge((*tool_pair)(row, 1)));
      }
    }
  }
  to_nodes(shape, control, node_force.chunk(chunk));
}

}  // namespace pulvis
