// tool_contact: narrow phase between particles and rigid tools: the Gauss points of every candidate
// edge against the tool's surface, a plane or a polyline.
//
// Stages   active_pairs -> tool_projection -> contact_law -> contact_sums (systems/contact/two_candidates.hpp); one
//          pass with the full stiffness, since a tool is not sampled
// Runs     after bin_edges and tool_motion, before contact_force
// Active   when the scene has tools
#include "systems/contact/active_pairs.hpp"
#include "systems/contact/contact_law.hpp"
#include "systems/tools/systems.hpp"
#include "systems/tools/tool_rows.hpp"

namespace pulvis {
namespace {

using Two = TwoCandidates<ToolContact>;

// One pass over the active pairs.
struct ToolPass {
  static constexpr double share = 1;  // of the stiffness
  using Sums = LaneSums;
  const tool_contact& s;
  const double* points = s.curves.position.values().data();
  const double* rates = s.curves.velocity ? s.curves.velocity->values().data() : nullptr;

  // ---- active pairs
  [[gnu::always_inline]] bool active(Row<ToolContact> row) const {
    return s.clock->relative_motion >= s.columns.state.activation(row);
  }
  [[gnu::always_inline]] void fetch(Row<ToolContact> row) const { pulvis::fetch(s.columns, row); }
  void fetch_other(Row<ToolContact>) const {}
  void operator()(const Two& two, LaneSums& sums) const {
    const SampledEdges edges = SampledEdges::of(*s.bodies, s.columns.pair, two);
    const PointLanes at = edges.points(points);
    PointMotion motion =
        halves_of(project(two[0], at, edges.length[0]), project(two[1], at, edges.length[1]));
    pass_over_bonded(s.columns, two, motion);
    const unsigned touching = find_touching(two, motion);
    if (touching == 0) return;
    motion.gap_rate = motion.slip_rate = Lane{};
    if (rates != nullptr) {
      const Row<Tool> a(s.columns.pair(two[0], 2)), b(s.columns.pair(two[1], 2));
      set_rates(edges.points(rates), halves(s.tool_velocity(a, 0), s.tool_velocity(b, 0)),
                halves(s.tool_velocity(a, 1), s.tool_velocity(b, 1)), motion);
    }
    act(s.columns, two, touching, motion, share, s.clock->dt_before, sums,
        [&] { return edges.hardness(*s.curves.hardness); });
  }

  // ---- projection
  PointMotion project(Row<ToolContact> row, const PointLanes& at, double farthest) const {
    return gap_to_tool(s.tools, s.range, row, s.columns.pair(row, 2), at, farthest);
  }
  // Those of the two candidates that touch (bit 0, bit 1); the others are set to apart.
  unsigned find_touching(const Two& two, const PointMotion& m) const {
    unsigned touching = 0;
    const Lane range = range_of(s.columns, two);
    for (int i = 0; i < count_of(two); ++i) {
      const double deepest = greatest_of_half(m.gap + range, i);
      if (deepest > 0)
        touching |= 1U << i;
      else
        set_apart(s.columns, entry(two, i), s.clock->relative_motion - deepest);
    }
    return touching;
  }
};

}  // namespace

void tool_contact::operator()(SmallTasks) const {
  for_active_pairs(*summed.blocks, summed.sums->blocks, ToolPass{*this});
}

}  // namespace pulvis
