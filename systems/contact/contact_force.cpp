// contact_force: gathers what every contact row does to a particle, as sampled and as other body, onto
// its control points, and from there onto its boundary nodes.
//
// Runs     after the narrow phase, before integrate
// Order    a particle sums its own rows in row order: the same bits for any number of threads
#include "engine/entry.hpp"
#include "systems/contact/contact_row.hpp"
#include "systems/contact/systems.hpp"

namespace pulvis {
namespace {

// x and y of four control points, as they lie in memory.
using ControlForce = Lane;

// The edges, by their first control point, that bear a force on some particle of the chunk. The others are passed
// over: their forces are zero, since to_nodes clears what it has read and nobody else writes them.
using Touched = std::vector<std::uint8_t>;

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

// The force of a point for all control points, from the row's list.
ControlForce force_at(const double* point_force, int g) { return repeat_pair(point_force + 2 * g); }

// Forces of a row's four points on the four control points of the sampled edge.
void add_sampled(const std::array<ControlForce, edge_points>& by_point, const double* point_force,
                 double* edge_force) {
  ControlForce sum = ControlForce::load(edge_force);
  for (int g = 0; g < edge_points; ++g)
    sum = fma(entry(by_point, g), force_at(point_force, g), sum);
  sum.store(edge_force);
}

// The opposite forces on the other body, at the closest point of each Gauss point. `edge_force`: of the
// body's first edge.
void add_other(const Polynomial& n, const double* closest, const double* f, const double* couple,
               double* edge_force, Touched& touched) {
  std::array<int, edge_points> edge;  // by its first control point
  std::array<ControlForce, edge_points> force;
  for (int g = 0; g < edge_points; ++g) {
    const auto at = static_cast<std::size_t>(g);
    edge[at] = static_cast<int>(closest[g]);
    const double u = closest[g] - edge[at];
    force[at] = n.value(u) * force_at(f, g);
    if (couple != nullptr) force[at] = fma(n.slope(u), force_at(couple, g), force[at]);
  }
  const auto subtract = [&](int e, const ControlForce& sum) {
    double* out = edge_force + CurveForce::count * e;
    entry(touched, e) = 1;
    (ControlForce::load(out) - sum).store(out);
  };
  // The points of an edge stand against one or two of the other's as a rule: no waiting for memory then.
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

// Forces of edges to boundary nodes, eight particles at once: an edge's four control points each, then the
// transpose of y = S x. `edge_force`: of the first particle's first edge, `numbers` a particle.
template <class Nodes>
void to_nodes(const Shape& shape, double* edge_force, std::size_t numbers, const Touched& touched,
              const Nodes& node_force) {
  for (int node = 0; node < shape.boundary_nodes; ++node)
    node_force(Row<BoundaryNode>(node), 0) = node_force(Row<BoundaryNode>(node), 1) = Lane{};
  std::array<Lane, 8> sum{};  // x y of control points c ... c + 3, of the edges up to c
  int borne = 0;              // of these, how many may bear a force
  for (int c = 0; c < shape.control_points(); ++c) {
    if (entry(touched, c) != 0) {
      std::array<const double*, lane_count> rows;
      for (std::size_t l = 0; l < lane_count; ++l)
        rows[l] = edge_force + l * numbers + static_cast<std::size_t>(c) * CurveForce::count;
      const auto of_edge = columns_of(rows);
      for (std::size_t k = 0; k < 8; ++k) sum[k] += of_edge[k];
      for (std::size_t l = 0; l < lane_count; ++l)
        Lane{}.store(edge_force + l * numbers + static_cast<std::size_t>(c) * CurveForce::count);
      borne = 4;
    }
    if (borne == 0) continue;
    --borne;
    for (std::int32_t t = entry(shape.curve_begin, c);
         t < shape.curve_begin[static_cast<std::size_t>(c) + 1]; ++t) {
      const Shape::CurveTerm& term = entry(shape.curve_terms, t);
      node_force(term.node, 0) += term.weight * sum[0];
      node_force(term.node, 1) += term.weight * sum[1];
    }
    sum = {sum[2], sum[3], sum[4], sum[5], sum[6], sum[7], Lane{}, Lane{}};
  }
}

}  // namespace

[[gnu::flatten]] void contact_force::operator()(Chunk chunk) const {
  static const auto by_point = basis_by_point();
  const Polynomial& n = basis();
  const Shape& shape = bodies->shape_of_chunk(chunk);
  double* all = &curve_force.chunk(chunk)(Row<ControlPoint>(0));
  const std::size_t numbers =  // of a particle
      CurveForce::count * static_cast<std::size_t>(shape.control_points());
  Touched touched(static_cast<std::size_t>(shape.control_points()));

  const bool from_memory = index->other_rows.size() > rows_in_cache;
  // The rows that touch are some among many and stand anywhere: their lines are asked for before they are
  // needed, those of the next particle too.
  const auto fetch_sampled = [&](std::size_t slot) {
    if (!from_memory || slot + 1 >= index->sampled_begin.size()) return;
    for (int r = index->sampled_begin[slot]; r < index->sampled_begin[slot + 1]; ++r) {
      const Row<Contact> row(r);
      if (pairs->touching.rows.touches(row) == 0) continue;
      prefetch(&pairs->place(row));
      prefetch(&pairs->touching.rows.force(row));
    }
  };
  const auto fetch_other = [&](std::size_t k) {
    if (!from_memory) return;
    const auto& rows = index->other_rows;
    if (k + 48 < rows.size()) prefetch(&pairs->touching.rows.touches(Row<Contact>(rows[k + 48])));
    if (k + 24 >= rows.size()) return;
    const Row<Contact> row(rows[k + 24]);
    if (pairs->touching.rows.touches(row) == 0) return;
    prefetch(&pairs->touching.closest(row));
    prefetch(&pairs->touching.rows.force(row));
    if (pairs->couple) prefetch(&(*pairs->couple)(row));
  };

  const auto sampled = [&](const double* force, double* own, int edge) {
    entry(touched, edge) = 1;
    add_sampled(by_point, force, own + CurveForce::count * edge);
  };
  for (int lane = 0; lane < lane_count; ++lane) {
    const auto slot = static_cast<std::size_t>(lane_count * chunk.index + lane);
    double* own = all + static_cast<std::size_t>(lane) * numbers;
    if (pairs) {
      const int first_control = bodies->slots[slot].first_control;
      fetch_sampled(slot + 1);
      for (int r = index->sampled_begin[slot]; r < index->sampled_begin[slot + 1]; ++r) {
        const Row<Contact> row(r);
        if (pairs->touching.rows.touches(row) != 0)
          sampled(&pairs->touching.rows.force(row), own, pairs->place(row, 0) - first_control);
      }
      for (int k = index->other_begin[slot]; k < index->other_begin[slot + 1]; ++k) {
        fetch_other(static_cast<std::size_t>(k));
        const Row<Contact> row(entry(index->other_rows, k));
        if (pairs->touching.rows.touches(row) != 0)
          add_other(n, &pairs->touching.closest(row), &pairs->touching.rows.force(row),
                    pairs->couple ? &(*pairs->couple)(row) : nullptr, own, touched);
      }
    }
    if (tools) {
      for (int r = index->tool_begin[slot]; r < index->tool_begin[slot + 1]; ++r) {
        const Row<ToolContact> row(r);
        if (tools->touches(row) != 0)
          sampled(&tools->force(row), own, entry(shape.edges, tools->pair(row, 1)).first_control);
      }
    }
  }
  to_nodes(shape, all, numbers, touched, node_force.chunk(chunk));
}

}  // namespace pulvis
