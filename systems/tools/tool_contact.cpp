// tool_contact: narrow phase between particles and rigid tools: the Gauss points of every candidate
// edge against the tool's surface, a plane or a polyline.
//
// Stages   active_pairs -> tool_projection -> contact_law -> contact_sums (systems/contact/two_candidates.hpp); one
//          pass with the full stiffness, since a tool is not sampled
// Runs     after bin_edges and tool_motion, before contact_force
// Active   when the scene has tools
#include "engine/entry.hpp"
#include "systems/contact/active_pairs.hpp"
#include "systems/contact/contact_law.hpp"
#include "systems/tools/systems.hpp"
#include "systems/tools/tool_projection.hpp"

namespace pulvis {
namespace {

using Two = TwoCandidates<ToolContact>;

// The sampled edges of two candidates.
struct SampledEdges {
  std::array<double, 2> length;               // m
  std::array<std::int32_t, 2> first_control;  // of all

  PointLanes points(const double* list) const {
    return edge_points_at(list + 2 * first_control[0], list + 2 * first_control[1]);
  }
};

// One pass over the active pairs.
struct ToolPass {
  static constexpr double share = 1;  // of the stiffness
  const tool_contact& s;
  const double* points = s.curves.position.values().data();
  const double* rates = s.curves.velocity ? s.curves.velocity->values().data() : nullptr;

  // ---- active pairs
  [[gnu::always_inline]] bool active(Row<ToolContact> row) const {
    return s.clock->travel >= s.columns.activation(row);
  }
  [[gnu::always_inline]] void fetch(Row<ToolContact> row) const { pulvis::fetch(s.columns, row); }
  void fetch_other(Row<ToolContact>) const {}
  void operator()(const Two& two, LaneSums& sums) const {
    const SampledEdges edges = sampled_edges(two);
    const PointLanes at = edges.points(points);
    PointMotion motion =
        halves_of(project(two[0], at, edges.length[0]), project(two[1], at, edges.length[1]));
    const unsigned touching = find_touching(two, motion);
    if (touching == 0) return;
    motion.gap_rate = motion.slip_rate = Lane{};
    if (rates != nullptr) {
      const Row<Tool> a(s.columns.pair(two[0], 2)), b(s.columns.pair(two[1], 2));
      set_rates(edges.points(rates), halves(s.tool_velocity(a, 0), s.tool_velocity(b, 0)),
                halves(s.tool_velocity(a, 1), s.tool_velocity(b, 1)), motion);
    }
    act(s.columns, two, touching, motion, share, s.clock->dt_before, sums);
  }

  // ---- projection
  SampledEdges sampled_edges(const Two& two) const {
    SampledEdges edges;
    for (int i = 0; i < 2; ++i) {
      const int slot = s.columns.pair(entry(two, i), 0);
      const Shape::Edge& edge =
          entry(s.bodies->shape_of_slot(slot).edges, s.columns.pair(entry(two, i), 1));
      entry(edges.length, i) = edge.length;
      entry(edges.first_control, i) =
          entry(s.bodies->slots, slot).first_control + edge.first_control;
    }
    return edges;
  }
  // Of all points, as if the candidate's tool were that of both.
  PointMotion project(Row<ToolContact> row, const PointLanes& at, double farthest) const {
    const Row<Tool> tool(s.columns.pair(row, 2));
    const Point stands{s.tools.position(tool, 0), s.tools.position(tool, 1)};
    // Farther than an edge the range of pieces tells nothing; see bin_tool_edges.
    if (s.range && (*s.tools.shapes)->is(tool.value, ToolShapes::Kind::polyline))
      return project_on_polyline(stands, (*s.tools.shapes)->surface_of(tool.value),
                                 (*s.range)(row, 0), (*s.range)(row, 1), at, farthest);
    return project_on_plane(stands, {s.tools.normal(tool, 0), s.tools.normal(tool, 1)}, at);
  }

  // The candidates of the two that touch (bit 0, bit 1); the others are set apart.
  unsigned find_touching(const Two& two, const PointMotion& m) const {
    unsigned touching = 0;
    for (int i = 0; i < count_of(two); ++i) {
      const double deepest = greatest_of_half(m.gap, i);
      if (deepest > 0)
        touching |= 1U << i;
      else
        set_apart(s.columns, entry(two, i), s.clock->travel - deepest);
    }
    return touching;
  }
};

}  // namespace

void tool_contact::operator()(SmallTasks) const {
  for_active_pairs(columns.pair.rows(), *sums, ToolPass{*this});
}

}  // namespace pulvis
