// contact_quality: how far the outlines penetrate each other, and which contacts are too narrow for their mesh.
//
// Law      overlap = sum over the penetrating points of depth times tributary length; for a pair both half
//          passes see all of it, hence half of each. Penetration work = sum of normal force times gap:
//          the tool displacement that penetration costs, by virtual work (scenes/results/contact_findings.hpp).
//          Width of a contact in edges: sum of the tributary shares of its touching points in their edges. A
//          face of one edge between two corners counts as wide enough: if the whole of it is in contact it is
//          not a contact of curved outlines
// Runs     on sampled steps, after the narrow phases
// Active   when contact is possible
#include <algorithm>

#include "engine/entry.hpp"
#include "systems/contact/by_slot.hpp"
#include "systems/contact/contact_outlines.hpp"
#include "systems/observe/nearest_of_tool.hpp"
#include "systems/observe/quality_sum.hpp"
#include "systems/observe/systems.hpp"

namespace pulvis {
namespace {

// Contact of one outline with one other, or with a tool.
struct Side {
  int other = 0;
  Point force{};      // N
  double edges = 0;   // -, width in edges
  double width = 0;   // m
  bool face = false;  // a whole face of one edge between two corners
};

// Contributions of one particle.
struct Found {
  double overlap = 0;  // m^2
  double work = 0;     // J
  std::vector<Side> sides;

  Side& with(int other) {
    const auto found = std::ranges::find(sides, other, &Side::other);
    if (found != sides.end()) return *found;
    sides.emplace_back().other = other;
    return sides.back();
  }
};

struct Gap {
  double depth;  // m, > 0 in penetration
  Point normal;  // into the sampled particle
};

// `gap_at(point, g)`: depth of the row's point in the other body. `share` of the overlap counted for the row.
template <class At, class GapAt>
void add_row(const Curve& sampled, const Shape::Edge& edge, const Read<PointForce<At>>& force,
             Row<At> row, double share, int other, const GapAt& gap_at, Found& found) {
  Side& side = found.with(other);
  side.face |= edge.previous == Shape::no_edge && edge.next == Shape::no_edge;
  for (int g = 0; g < edge_points; ++g) {
    const Point f{force(row, 2 * g), force(row, 2 * g + 1)};
    if (f[0] == 0 && f[1] == 0) continue;
    const double u = kernels::edge_u[g], w = kernels::edge_w[g];
    const double length = w * length_of(sampled.slope(u));
    const Gap gap = gap_at(sampled.value(u), g);
    side.force[0] += f[0];
    side.force[1] += f[1];
    side.edges += w;
    side.width += length;
    if (gap.depth <= 0) continue;  // held by a bond or by adhesion
    found.overlap += share * length * gap.depth;
    found.work += gap.depth * (f[0] * gap.normal[0] + f[1] * gap.normal[1]);
  }
}

ContactQuality quality_of(const Found& found) {
  ContactQuality of_one{.overlap = found.overlap, .penetration_work = found.work};
  for (const Side& side : found.sides) {
    const double force = length_of(side.force);
    of_one.force += force;
    if (side.edges >= ContactQuality::min_edges || side.face) continue;
    of_one.narrow_force += force;
    of_one.narrow_width += force * side.width;
    of_one.narrow_edges += force * side.edges;
  }
  return of_one;
}

}  // namespace

void contact_quality::operator()() const {
  const Outlines outlines(*bodies, control.values());
  const auto edge_of = [&](int slot, int edge) -> const Shape::Edge& {
    return entry(bodies->shape_of_slot(slot).edges, edge);
  };
  const auto gap_to_curve = [&](Row<Contact> row, const Point& sampled, int g) {
    const Point at = pairs->from_image(row, sampled);
    const CurvePoint there = pairs->closest(row, g).unpacked();
    const Curve curve = outlines.from(pairs->rows.pair(row, 2), there.edge);
    const Point m = curve.value(there.u), n = curve.normal(there.u);
    return Gap{(m[0] - at[0]) * n[0] + (m[1] - at[1]) * n[1], n};
  };
  const auto gap_to_tool = [&](Row<ToolContact> row, const Point& at) {
    const auto [distance, normal] = nearest_of_tool(*tools, row, at);
    return Gap{-distance, normal};
  };
  const auto add_pairs = [&](int slot, Found& found) {
    const auto s = static_cast<std::size_t>(slot);
    for (int r = index->sampled_begin[s]; r < index->sampled_begin[s + 1]; ++r) {
      const Row<Contact> row(r);
      if (pairs->rows.touches(row) == 0) continue;
      const int edge = pairs->rows.pair(row, 1);
      add_row(
          outlines.edge(slot, edge), edge_of(slot, edge), pairs->rows.force, row, 0.5,
          pairs->rows.pair(row, 2),
          [&](const Point& at, int g) { return gap_to_curve(row, at, g); }, found);
    }
  };
  const auto add_tools = [&](int slot, Found& found) {
    const auto s = static_cast<std::size_t>(slot);
    for (int r = index->tool_begin[s]; r < index->tool_begin[s + 1]; ++r) {
      const Row<ToolContact> row(r);
      if (tools->rows.touches(row) == 0) continue;
      const int edge = tools->rows.pair(row, 1), tool = tools->rows.pair(row, 2);
      add_row(
          outlines.edge(slot, edge), edge_of(slot, edge), tools->rows.force, row, 1, -1 - tool,
          [&](const Point& at, int) { return gap_to_tool(row, at); }, found);
    }
  };

  const auto found = list_by_slot<ContactQuality>(static_cast<int>(bodies->slots.size()),
                                                  [&](int slot, std::vector<ContactQuality>& list) {
                                                    Found mine;
                                                    if (!bodies->owns(slot)) return;
                                                    if (pairs) add_pairs(slot, mine);
                                                    if (tools) add_tools(slot, mine);
                                                    if (!mine.sides.empty())
                                                      list.push_back(quality_of(mine));
                                                  });
  *quality = exact_sum(found.all, link);
}

}  // namespace pulvis
