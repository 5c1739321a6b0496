// bin_edges: broad phase: makes the contact rows anew when the surfaces have moved through the skin.
//
// History (closest points, friction springs) is carried by the key (particle, edge, other): rows are
// sorted by it, so that old and new lists are merged in one pass.
// Runs     first in the step; a sync point (rows change); does nothing while the skin lasts
#include <algorithm>

#include "systems/broad_phase.hpp"
#include "systems/contact_row.hpp"
#include "systems/surface_search.hpp"
#include "systems/systems.hpp"

namespace pulvis {
namespace {

struct RowKey {
  std::int32_t slot, edge, other;
  auto operator<=>(const RowKey&) const = default;
};

template <class At>
std::vector<RowKey> keys_of(const Write<ContactPair<At>>& pair) {
  std::vector<RowKey> keys;
  for (int r = 0; r < pair.rows(); ++r)
    keys.push_back({pair(Row<At>(r), 0), pair(Row<At>(r), 1), pair(Row<At>(r), 2)});
  return keys;
}

// For every new key the old row with the same key, or -1. Both lists sorted.
std::vector<std::int32_t> match(const std::vector<RowKey>& before, const std::vector<RowKey>& now) {
  std::vector<std::int32_t> source(now.size(), -1);
  std::size_t b = 0;
  for (std::size_t n = 0; n < now.size(); ++n) {
    while (b < before.size() && before[b] < now[n]) ++b;
    if (b < before.size() && before[b] == now[n]) source[n] = static_cast<std::int32_t>(b);
  }
  return source;
}

// Offsets of each slot's share of a list sorted by slot.
template <class SlotOf>
std::vector<std::int32_t> offsets(std::size_t slots, std::size_t rows, const SlotOf& slot_of) {
  std::vector<std::int32_t> begin(slots + 1, 0);
  for (std::size_t r = 0; r < rows; ++r) begin[static_cast<std::size_t>(slot_of(r)) + 1] += 1;
  for (std::size_t s = 0; s < slots; ++s) begin[s + 1] += begin[s];
  return begin;
}

struct PairLaw {
  double kappa, friction, damping;
};

template <class At>
void set_row(Row<At> row, const Bodies& bodies, const RowKey& key, const PairLaw& law,
             const RowConstants<At>& c) {
  const Shape::Edge& edge =
      bodies.shape_of_slot(key.slot).edges[static_cast<std::size_t>(key.edge)];
  c.pair(row, 0) = key.slot;
  c.pair(row, 1) = key.edge;
  c.pair(row, 2) = key.other;
  c.length(row) = edge.length;
  c.stiffness(row) = law.kappa;
  for (std::size_t g = 0; g < edge_points; ++g)
    c.weight(row, static_cast<int>(g)) = edge.weight[g] * bodies.thickness;
  if (c.friction) (*c.friction)(row) = law.friction;
  if (c.damping) (*c.damping)(row) = law.damping;
}

// kappa = k K L/A of the sampled edge in series with the other outline's mean, like two springs: a disc
// on its mirror image feels what it feels on a rigid plane. Not with the edge that happens to be nearest: a kappa that changed while two bodies slide would make or eat energy.
double pair_stiffness(const ContactRules& rules, std::span<const double> bulk, const Bodies& bodies,
                      const RowKey& key) {
  const auto slot = static_cast<std::size_t>(key.slot), other = static_cast<std::size_t>(key.other);
  const Shape& shape = bodies.shape_of_slot(key.slot);
  const double a = bulk[slot] * shape.edges[static_cast<std::size_t>(key.edge)].stiffness;
  const double b = bulk[other] * bodies.shape_of_slot(key.other).mean_edge_stiffness;
  return rules.stiffness * a * b / (a + b);
}

// c = 2 xi sqrt(kappa rho h): the boundary element's mass per area on the contact spring.
double damping_of(const ContactRules& rules, double kappa, double rho, const Shape::Edge& edge) {
  return 2 * rules.damping * std::sqrt(kappa * rho / edge.stiffness);
}

}  // namespace

void bin_edges(Read<Bodies> bodies, Read<Clock> clock, Read<ContactRules> rules,
               Read<BulkModulus> bulk, Read<Density> density, Read<CurvePosition> control,
               Write<ContactIndex> index, Structural<Contact> structure,
               Write<ContactPair<Contact>> pair, Write<EdgeLength<Contact>> length,
               Write<ContactStiffness<Contact>> stiffness, Write<ContactWeight<Contact>> weight,
               Write<ContactReach<Contact>> reach, Write<ClosestPoint> closest,
               Optional<Write<FrictionCoefficient<Contact>>> friction,
               Optional<Write<DampingCoefficient<Contact>>> damping) {
  if (!skin_used_up(*index, *clock)) return;
  const std::vector<EdgeCandidate> found = edge_candidates(*bodies, control.values(), index->skin);
  std::vector<RowKey> keys;
  for (const EdgeCandidate& c : found) keys.push_back({c.slot, c.edge, c.other});
  const std::vector<std::int32_t> source = match(keys_of(pair), keys);
  structure.rebuild(source);

  const RowConstants<Contact> columns{pair, length, stiffness, weight, friction, damping};
  for (std::size_t r = 0; r < keys.size(); ++r) {
    const Row<Contact> row(static_cast<std::int64_t>(r));
    const RowKey& key = keys[r];
    const auto& slots = bodies->slots;
    const double kappa = pair_stiffness(*rules, bulk.values(), *bodies, key);
    const double rho = std::min(density.values()[static_cast<std::size_t>(key.slot)],
                                density.values()[static_cast<std::size_t>(key.other)]);
    const Shape::Edge& edge =
        bodies->shape_of_slot(key.slot).edges[static_cast<std::size_t>(key.edge)];
    set_row(row, *bodies, key,
            {kappa,
             rules->friction_between(slots[static_cast<std::size_t>(key.slot)].material,
                                     slots[static_cast<std::size_t>(key.other)].material),
             damping_of(*rules, kappa, rho, edge)},
            columns);
    const bool known = source[r] >= 0;
    // What was found to be the far side of a thin part stays that (edge_contact).
    if (!(known && reach(row) == far_side))
      reach(row) = known || key.slot != key.other ? 0 : unseen;
    if (!known)
      for (int g = 0; g < edge_points; ++g) closest(row, g) = found[r].start + 0.5;
  }

  const std::size_t slots = bodies->slots.size();
  index->sampled_begin = offsets(slots, keys.size(), [&](std::size_t r) { return keys[r].slot; });
  index->other_begin = offsets(slots, keys.size(), [&](std::size_t r) { return keys[r].other; });
  index->other_rows.resize(keys.size());
  std::vector<std::int32_t> next = index->other_begin;
  for (std::size_t r = 0; r < keys.size(); ++r)
    index->other_rows[static_cast<std::size_t>(next[static_cast<std::size_t>(keys[r].other)]++)] =
        static_cast<std::int32_t>(r);
}

namespace {

struct ToolCandidates {
  std::vector<RowKey> keys;
  std::vector<PieceRange> ranges;  // of polylines; as many as keys where the scene has any
};

// The pieces of a polyline that an edge can touch, or stand behind by up to its
// own length, before the skin is used up. (Deeper than that no force would be right.)
void add_near_pieces(const ToolSurface& surface, Point at, const double* points, double reach,
                     const RowKey& key, ToolCandidates& found) {
  Box box = box_of(points, 4);
  for (int k = 0; k < 2; ++k) {
    box.low[k] -= at[static_cast<std::size_t>(k)];
    box.high[k] -= at[static_cast<std::size_t>(k)];
  }
  const PieceRange range = pieces_near(surface, box, reach);
  if (range.empty()) return;
  found.keys.push_back(key);
  found.ranges.push_back(range);
}

// Edges within `skin` of a tool's surface, or behind it.
ToolCandidates tool_candidates(const Bodies& bodies, std::span<const double> control,
                               const Read<ToolPosition>& position, const Read<ToolNormal>& normal,
                               const Optional<Read<ToolShapes>>& shapes, double skin) {
  std::vector<int> slots = bodies.slot_of_number;
  std::ranges::sort(slots);
  ToolCandidates found;
  for (const int s : slots) {
    const double* points =
        control.data() + 2 * bodies.slots[static_cast<std::size_t>(s)].first_control;
    const auto& edges = bodies.shape_of_slot(s).edges;
    for (int e = 0; e < static_cast<int>(edges.size()); ++e)
      for (int t = 0; t < position.rows(); ++t) {
        const Row<Tool> tool(t);
        if (shapes && !(*shapes)->is(t, ToolShapes::Kind::plane)) {
          const Shape::Edge& edge = edges[static_cast<std::size_t>(e)];
          if ((*shapes)->is(t, ToolShapes::Kind::polyline))
            add_near_pieces((*shapes)->surface_of(t), {position(tool, 0), position(tool, 1)},
                            points + 2 * edge.first_control, skin + edge.length, {s, e, t}, found);
          continue;
        }
        double least = std::numeric_limits<double>::max();
        for (int a = 0; a < 4; ++a) {
          const double* y = points + 2 * (edges[static_cast<std::size_t>(e)].first_control + a);
          least = std::min(least, (y[0] - position(tool, 0)) * normal(tool, 0) +
                                      (y[1] - position(tool, 1)) * normal(tool, 1));
        }
        if (least >= skin) continue;
        found.keys.push_back({s, e, t});
        if (shapes) found.ranges.emplace_back();
      }
  }
  return found;
}

}  // namespace

void bin_tool_edges(Read<Bodies> bodies, Read<Clock> clock, Read<ContactRules> rules,
                    Read<BulkModulus> bulk, Read<Density> density, Read<CurvePosition> control,
                    Read<ToolPosition> tool_position, Read<ToolNormal> tool_normal,
                    Write<ContactIndex> index, Structural<ToolContact> structure,
                    Write<ContactPair<ToolContact>> pair, Write<EdgeLength<ToolContact>> length,
                    Write<ContactStiffness<ToolContact>> stiffness,
                    Write<ContactWeight<ToolContact>> weight,
                    Write<ContactReach<ToolContact>> reach,
                    Optional<Write<FrictionCoefficient<ToolContact>>> friction,
                    Optional<Write<DampingCoefficient<ToolContact>>> damping,
                    Optional<Read<ToolShapes>> shapes, Optional<Write<SurfaceRange>> range) {
  if (!skin_used_up(*index, *clock)) return;
  const auto found =
      tool_candidates(*bodies, control.values(), tool_position, tool_normal, shapes, index->skin);
  const std::vector<RowKey>& keys = found.keys;
  structure.rebuild(match(keys_of(pair), keys));
  const RowConstants<ToolContact> columns{pair, length, stiffness, weight, friction, damping};
  for (std::size_t r = 0; r < keys.size(); ++r) {
    const Row<ToolContact> row(static_cast<std::int64_t>(r));
    const RowKey& key = keys[r];
    const auto slot = static_cast<std::size_t>(key.slot);
    const Shape::Edge& edge =
        bodies->shape_of_slot(key.slot).edges[static_cast<std::size_t>(key.edge)];
    const double kappa = rules->stiffness * bulk.values()[slot] * edge.stiffness;
    set_row(row, *bodies, key,
            {kappa, rules->friction_with_tool(key.other, bodies->slots[slot].material),
             damping_of(*rules, kappa, density.values()[slot], edge)},
            columns);
    reach(row) = 0;
    if (!range) continue;
    (*range)(row, 0) = found.ranges[r].first;
    (*range)(row, 1) = found.ranges[r].last;
  }
  index->tool_begin =
      offsets(bodies->slots.size(), keys.size(), [&](std::size_t r) { return keys[r].slot; });
}

void note_binning(Read<Clock> clock, Write<ContactIndex> index) {
  if (!skin_used_up(*index, *clock)) return;
  index->travel_at_bin = clock->travel;
  index->bins += 1;
}

}  // namespace pulvis
