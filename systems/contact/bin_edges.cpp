// bin_edges, bin_tool_edges: broad phase: rebuild the contact rows when the surfaces have moved through the
// skin.
//
// History (closest points, friction springs) is carried over by the key (particle, edge, other): rows are
// sorted by it, so that old and new rows of a particle are merged in one pass.
// Runs     after skin_check, which triggers it; a sync point (rows change)
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <numeric>

#include "engine/entry.hpp"
#include "systems/contact/broad_phase.hpp"
#include "systems/contact/surface_search.hpp"
#include "systems/contact/systems.hpp"

namespace pulvis {
namespace {

struct RowKey {
  std::int32_t slot, edge, other;
  Image image{};
  auto operator<=>(const RowKey&) const = default;
  bool itself() const { return slot == other && image == Image{}; }
};

struct ToolCandidate {
  std::int32_t slot, edge, tool;
  PieceRange range;  // of a polyline
};

RowKey key_of(const EdgeCandidate& c) { return {c.slot, c.edge, c.other, c.image}; }
RowKey key_of(const ToolCandidate& c) { return {c.slot, c.edge, c.tool}; }

// The keys of the rows from the previous build.
template <class At>
struct KeysBefore {
  const Write<ContactPair<At>>& pair;
  RowKey operator()(Row<At> row) const { return {pair(row, 0), pair(row, 1), pair(row, 2)}; }
};
struct PairKeysBefore {
  const Write<ContactPair<Contact>>& pair;
  const Optional<Write<ContactImage<Contact>>>& image;
  RowKey operator()(Row<Contact> row) const {
    const Image n = image ? Image{(*image)(row, 0), (*image)(row, 1)} : Image{};
    return {pair(row, 0), pair(row, 1), pair(row, 2), n};
  }
};

// For every new row the old one with the same key, or -1. Old rows of a slot: `before_begin`, from the previous
// build; empty if there was none.
template <class At, class Keys, class Candidate>
std::vector<std::int32_t> match(const std::vector<std::int32_t>& before_begin, const Keys& before,
                                const BySlot<Candidate>& now) {
  std::vector<std::int32_t> source(now.all.size(), -1);
  if (before_begin.empty()) return source;
  for_slots(static_cast<int>(now.begin.size()) - 1, [&](int slot) {
    std::int32_t b = entry(before_begin, slot);
    const std::int32_t end = entry(before_begin, slot + 1);
    const auto old_key = [&] { return before(Row<At>(b)); };
    for (auto n = entry(now.begin, slot); n < entry(now.begin, slot + 1); ++n) {
      const RowKey key = key_of(entry(now.all, n));
      while (b < end && old_key() < key) ++b;
      if (b < end && old_key() == key) entry(source, n) = b;
    }
  });
  return source;
}

struct PairLaw {
  double kappa;     // Pa/m
  double friction;  // -, Coulomb coefficient
  int surfaces;     // number of their laws
  double damping;
  std::uint8_t weld;  // index of the bond law by which pressure welds
};

template <class At>
void set_row(Row<At> row, const Bodies& bodies, const RowKey& key, const PairLaw& law,
             const NewRows<At>& rows) {
  const Shape::Edge& edge = entry(bodies.shape_of_slot(key.slot).edges, key.edge);
  using Law = ContactLaw<At>;
  rows.pair(row, 0) = key.slot;
  rows.pair(row, 1) = key.edge;
  rows.pair(row, 2) = key.other;
  rows.law(row, Law::stiffness) = law.kappa;
  rows.law(row, Law::friction) = law.friction;
  if (rows.surface_law) (*rows.surface_law)(row) = law.surfaces;
  if (rows.bond_law) (*rows.bond_law)(row, BondLawNumber<At>::weld) = law.weld;
  rows.law(row, Law::damping) = law.damping;
  rows.law(row, Law::inv_size) = 1 / edge.length;
  for (std::size_t g = 0; g < edge_points; ++g)
    rows.law(row, Law::weight + static_cast<int>(g)) = edge.weight[g] * bodies.thickness;
}

// kappa = k K L/A of the sampled edge in series with the other outline's mean, like two springs: a disc on its mirror
// image behaves as on a rigid plane. Not with the edge that happens to be nearest: a kappa that changes while two bodies slide would create or destroy energy.
double pair_stiffness(const ContactRules& rules, std::span<const double> bulk, const Bodies& bodies,
                      const RowKey& key) {
  const Shape& shape = bodies.shape_of_slot(key.slot);
  const double a = entry(bulk, key.slot) * entry(shape.edges, key.edge).stiffness;
  const double b = entry(bulk, key.other) * bodies.shape_of_slot(key.other).mean_edge_stiffness;
  return rules.stiffness * a * b / (a + b);
}

// c = 2 xi sqrt(kappa rho h): with the mass per area of the boundary element on the contact spring.
double damping_of(const ContactRules& rules, double kappa, double rho, const Shape::Edge& edge) {
  return 2 * rules.damping * std::sqrt(kappa * rho / edge.stiffness);
}

double initial_stiffness(const Optional<Read<BondRules>>& bonds, const Bodies& bodies,
                         const RowKey& key) {
  if (!bonds || key.itself()) return 1;
  return (*bonds)->contact_stiffness(
      (*bonds)->initial_between(entry(bodies.slots, key.slot), entry(bodies.slots, key.other)));
}
double initial_stiffness_with_tool(const Optional<Read<BondRules>>& bonds, const Bodies& bodies,
                                   const RowKey& key) {
  if (!bonds) return 1;
  return (*bonds)->contact_stiffness(
      (*bonds)->initial_with_tool(key.other, entry(bodies.slots, key.slot)));
}

std::uint8_t weld_law(const Optional<Read<BondRules>>& bonds, const Bodies& bodies,
                      const RowKey& key) {
  if (!bonds || key.itself()) return 0;
  return (*bonds)->pressed_between(entry(bodies.slots, key.slot), entry(bodies.slots, key.other));
}
std::uint8_t tool_weld_law(const Optional<Read<BondRules>>& bonds, const Bodies& bodies,
                           const RowKey& key) {
  if (!bonds) return 0;
  return (*bonds)->pressed_with_tool(key.other, entry(bodies.slots, key.slot));
}

// A fold of one outline does not attract itself: what is near is usually the body's own neighbourhood.
int surfaces_of(const ContactRules& rules, const Bodies& bodies, const RowKey& key) {
  const int a = entry(bodies.slots, key.slot).material;
  return key.itself() ? rules.number_of_fold(a)
                      : rules.number_between(a, entry(bodies.slots, key.other).material);
}

// Flat flanks of one outline that overlap by more than the skin have separate boxes: their rows are kept while
// they touch.
BySlot<EdgeCandidate> with_touching_folds(const std::vector<std::int32_t>& before_begin,
                                          const PairKeysBefore& before,
                                          const Read<ContactTouches<Contact>>& touches,
                                          const BySlot<EdgeCandidate>& found) {
  return list_by_slot<EdgeCandidate>(
      static_cast<int>(found.begin.size()) - 1, [&](int slot, std::vector<EdgeCandidate>& list) {
        auto n = entry(found.begin, slot);
        const auto copy_below = [&](const RowKey* key) {
          for (; n < entry(found.begin, slot + 1); ++n) {
            const EdgeCandidate& c = entry(found.all, n);
            if (key != nullptr && !(key_of(c) < *key)) return key_of(c) == *key;
            list.push_back(c);
          }
          return false;
        };
        for (const Row<Contact> row : RowRange<Contact>::of(before_begin, slot)) {
          const RowKey key = before(row);
          if (!key.itself() || touches(row) == 0) continue;
          if (!copy_below(&key)) list.push_back({key.slot, key.edge, key.other, key.edge, false});
        }
        copy_below(nullptr);
      });
}

bool any_fold_touches(const PairKeysBefore& before, const Read<ContactTouches<Contact>>& touches) {
  for (int r = 0; r < touches.rows(); ++r) {
    const Row<Contact> row(r);
    if (touches(row) != 0 && before(row).itself()) return true;
  }
  return false;
}

}  // namespace

void bin_edges::operator()() const {
  if (!index->due) return;
  const ContactRules& rules = *material.rules;
  const PeriodicCell<TwoD>* periodic = outlines.cell ? &**outlines.cell : nullptr;
  BySlot<Neighbour> neighbours =
      particle_neighbours(*bodies, outlines.control.values(), periodic, index->neighbourhood);
  BySlot<EdgeCandidate> found = edge_candidates(*bodies, outlines.control.values(), periodic,
                                                neighbours, index->skin + index->reach);
  const PairKeysBefore before{rows.pair, curves.image};
  if (any_fold_touches(before, touches))
    found = with_touching_folds(index->sampled_begin, before, touches, found);
  const std::vector<std::int32_t> source = match<Contact>(index->sampled_begin, before, found);
  structure.rebuild(source);

  tbb::parallel_for(std::size_t{0}, found.all.size(), [&](std::size_t r) {
    const Row<Contact> row(static_cast<std::int64_t>(r));
    const RowKey key = key_of(found.all[r]);
    const auto& slots = bodies->slots;
    if (curves.image)
      for (int k = 0; k < 2; ++k) (*curves.image)(row, k) = entry(key.image, k);
    const double kappa = pair_stiffness(rules, material.bulk.values(), *bodies, key);
    const double rho = std::min(entry(material.density.values(), key.slot),
                                entry(material.density.values(), key.other));
    const Shape::Edge& edge = entry(bodies->shape_of_slot(key.slot).edges, key.edge);
    const int surfaces = surfaces_of(rules, *bodies, key);
    set_row(row, *bodies, key,
            {kappa * initial_stiffness(material.bonds, *bodies, key),
             entry(rules.pairs, surfaces).friction.coefficient, surfaces,
             damping_of(rules, kappa, rho, edge), weld_law(material.bonds, *bodies, key)},
            rows);
    // Self-contact is searched again from scratch: its closest points may have slid home along it (edge_contact).
    const bool again = found.all[r].faces && touches(row) == 0;
    const bool known = source[r] >= 0 && !again;
    // What was identified as the back face of a thin part stays so.
    if (!(known && rows.activation(row) == back_face)) rows.activation(row) = 0;
    curves.place(row, 0) = entry(slots, key.slot).first_control + edge.first_control;
    curves.place(row, 1) = entry(slots, key.other).first_control;
    if (known) return;
    const auto& edges = bodies->shape_of_slot(key.other).edges;
    for (int g = 0; g < edge_points; ++g) {
      const int start =
          start_of_point(*bodies, outlines.control.values(), periodic, found.all[r], g);
      curves.closest(row, g) = CurvePoint{entry(edges, start).first_control, 0.5}.packed();
    }
  });
  rows.blocks->divide(found.begin);
  index->sampled_begin = std::move(found.begin);
  index->list_others(rows.pair.values());
  keep_neighbours(neighbours, periodic, *index);
}

namespace {

// The pieces of a polyline that an edge can touch, or lie behind by up to its own length, before the skin
// is used up. (At greater depth no force would be correct.)
PieceRange near_pieces(const ToolSurface& surface, Point at, const double* points, double reach) {
  Box box = box_of(points, 4);
  for (int k = 0; k < 2; ++k) {
    box.low[k] -= entry(at, k);
    box.high[k] -= entry(at, k);
  }
  return pieces_near(surface, box, reach);
}

double min_distance(const double* points, Point at, Point normal) {
  double minimum = std::numeric_limits<double>::max();
  for (int a = 0; a < 4; ++a)
    minimum = std::min(
        minimum, (points[2 * a] - at[0]) * normal[0] + (points[2 * a + 1] - at[1]) * normal[1]);
  return minimum;
}

// Edges within `skin` of a tool's surface, or behind it.
BySlot<ToolCandidate> tool_candidates(const Bodies& bodies, std::span<const double> control,
                                      const ToolSurfaces& tools, double skin) {
  return list_by_slot<ToolCandidate>(
      static_cast<int>(bodies.slots.size()), [&](int slot, std::vector<ToolCandidate>& found) {
        const Bodies::Slot& s = entry(bodies.slots, slot);
        if (!bodies.owns(slot)) return;
        const auto& edges = bodies.shape_of_slot(slot).edges;
        for (std::int32_t e = 0; e < static_cast<std::int32_t>(edges.size()); ++e)
          for (int t = 0; t < tools.position.rows(); ++t) {
            const Row<Tool> tool(t);
            const Shape::Edge& edge = entry(edges, e);
            const double* points = control.data() + 2 * (s.first_control + edge.first_control);
            const Point at{tools.position(tool, 0), tools.position(tool, 1)};
            if (tools.is(t, ToolShapes::Kind::plane)) {
              if (min_distance(points, at, {tools.normal(tool, 0), tools.normal(tool, 1)}) < skin)
                found.push_back({slot, e, t, {}});
            } else if (tools.is(t, ToolShapes::Kind::polyline)) {
              const PieceRange range =
                  near_pieces((*tools.shapes)->surface_of(t), at, points, skin + edge.length);
              if (!range.empty()) found.push_back({slot, e, t, range});
            }
          }
      });
}

}  // namespace

void bin_tool_edges::operator()() const {
  if (!index->due) return;
  const ContactRules& rules = *material.rules;
  BySlot<ToolCandidate> found =
      tool_candidates(*bodies, control.values(), tools, index->skin + index->reach);
  structure.rebuild(
      match<ToolContact>(index->tool_begin, KeysBefore<ToolContact>{rows.pair}, found));
  for (std::size_t r = 0; r < found.all.size(); ++r) {
    const Row<ToolContact> row(static_cast<std::int64_t>(r));
    const RowKey key = key_of(found.all[r]);
    const Shape::Edge& edge = entry(bodies->shape_of_slot(key.slot).edges, key.edge);
    const double kappa = rules.stiffness * entry(material.bulk.values(), key.slot) * edge.stiffness;
    const int surfaces = rules.number_with_tool(key.other, entry(bodies->slots, key.slot).material);
    set_row(row, *bodies, key,
            {kappa * initial_stiffness_with_tool(material.bonds, *bodies, key),
             entry(rules.tool_pairs, surfaces).friction.coefficient, surfaces,
             damping_of(rules, kappa, entry(material.density.values(), key.slot), edge),
             tool_weld_law(material.bonds, *bodies, key)},
            rows);
    rows.activation(row) = 0;
    if (!range) continue;
    (*range)(row, 0) = found.all[r].range.first;
    (*range)(row, 1) = found.all[r].range.last;
  }
  rows.blocks->divide(found.begin);
  index->tool_begin = std::move(found.begin);
}

}  // namespace pulvis
