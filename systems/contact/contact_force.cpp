// contact_force: assembles all contact forces on a particle, as sampled and as other body, at its control points,
// and from there at its boundary nodes.
//
// Source   systems/contact/assembly.hpp
// Runs     after the narrow phase, before integrate
// Order    a particle sums its own candidates in order: bitwise identical for any number of threads
#include "engine/chunk_lane.hpp"
#include "systems/contact/active_pairs.hpp"
#include "systems/contact/assembly.hpp"
#include "systems/contact/systems.hpp"

namespace pulvis {
namespace {

// The candidates that touch are a few among many, scattered in memory in a large powder: their lines are
// prefetched.
struct Ahead {
  const ContactIndex& index;
  const contact_force::Pairs& pairs;
  bool from_memory;

  void sampled_by(int slot) const {
    if (!from_memory || slot + 1 >= static_cast<int>(index.sampled_begin.size())) return;
    for (const Row<Contact> row : index.sampled_by(slot)) {
      if (pairs.touching.rows.touches(row) == 0) continue;
      prefetch(&pairs.place(row));
      prefetch(&pairs.touching.rows.force(row));
    }
  }
  void others_after(int k) const {
    if (!from_memory) return;
    const auto& rows = index.other_rows;
    const int last = static_cast<int>(rows.size()) - 1;
    if (k + 48 <= last) prefetch(&pairs.touching.rows.touches(Row<Contact>(entry(rows, k + 48))));
    if (k + 24 > last) return;
    const Row<Contact> row(entry(rows, k + 24));
    if (pairs.touching.rows.touches(row) == 0) return;
    prefetch(&pairs.touching.closest(row));
    prefetch(&pairs.touching.rows.force(row));
    if (pairs.slope_load) prefetch(&(*pairs.slope_load)(row));
  }
};

void add_as_sampled(const contact_force::Pairs& pairs, const ContactIndex& index, int slot,
                    const BasisByPoint& by_point, int first_control, const EdgeForces& own) {
  for (const Row<Contact> row : index.sampled_by(slot))
    if (pairs.touching.rows.touches(row) != 0)
      add_sampled(by_point, &pairs.touching.rows.force(row),
                  own.on(pairs.place(row, 0) - first_control));
}

void add_as_other(const contact_force::Pairs& pairs, const ContactIndex& index, int slot,
                  const EdgeBasis& n, const Ahead& ahead, const EdgeForces& own) {
  for (int k = entry(index.other_begin, slot); k < entry(index.other_begin, slot + 1); ++k) {
    ahead.others_after(k);
    const Row<Contact> row(entry(index.other_rows, k));
    if (pairs.touching.rows.touches(row) != 0)
      add_other(n, &pairs.touching.closest(row), &pairs.touching.rows.force(row),
                pairs.slope_load ? &(*pairs.slope_load)(row) : nullptr, own);
  }
}

void add_of_tools(const TouchingRows<ToolContact>& tools, const ContactIndex& index, int slot,
                  const BasisByPoint& by_point, const Shape& shape, const EdgeForces& own) {
  for (const Row<ToolContact> row : index.with_tools(slot))
    if (tools.touches(row) != 0)
      add_sampled(by_point, &tools.force(row),
                  own.on(entry(shape.edges, tools.pair(row, 1)).first_control));
}

}  // namespace

[[gnu::flatten]] void contact_force::operator()(Chunk chunk) const {
  // Copies, which no written force can alias: they stay in registers.
  const BasisByPoint by_point = basis_by_point();
  const EdgeBasis n = edge_basis();
  const Shape& shape = bodies->shape_of_chunk(chunk);
  double* all = &curve_force.chunk(chunk)(Row<ControlPoint>(0));
  const std::ptrdiff_t numbers = CurveForce::count * shape.control_points();  // for one particle
  LoadedEdges loaded(static_cast<std::size_t>(shape.control_points()));
  for (int lane = 0; lane < lane_count; ++lane) {
    const int slot = ChunkLane(chunk, lane).slot();
    const EdgeForces own{all + lane * numbers, loaded};
    if (pairs) {
      const Ahead ahead{*index, *pairs, index->other_rows.size() > rows_in_cache};
      ahead.sampled_by(slot + 1);
      add_as_sampled(*pairs, *index, slot, by_point, entry(bodies->slots, slot).first_control, own);
      add_as_other(*pairs, *index, slot, n, ahead, own);
    }
    if (tools) add_of_tools(*tools, *index, slot, by_point, shape, own);
  }
  to_nodes(shape, all, numbers, loaded, node_force.chunk(chunk));
}

}  // namespace pulvis
