// tool_contact: narrow phase between particles and rigid tools: the Gauss points of every candidate
// edge against the tool's surface, a plane or a polyline.
//
// Source   systems/contact/contact_kernel.hpp; one pass with the full stiffness, since a tool is not sampled
// Runs     after bin_edges and tool_motion, before contact_force
// Active   when the scene has tools
#include "engine/entry.hpp"
#include "systems/contact/contact_row.hpp"
#include "systems/tools/surface_kernel.hpp"
#include "systems/tools/systems.hpp"

namespace pulvis {

void tool_contact::operator()(SmallTasks) const {
  const double* points = curves.position.values().data();
  const double* rates = curves.velocity ? curves.velocity->values().data() : nullptr;

  // Of both rows, as if `tool` were that of both.
  const auto gap_to = [&](Row<ToolContact> row, const PointLanes& at, double farthest) {
    const Row<Tool> tool(columns.pair(row, 2));
    const Lane rx = at.x - tools.position(tool, 0), ry = at.y - tools.position(tool, 1);
    RowMotion m;
    if (range && (*tools.shapes)->is(tool.value, ToolShapes::Kind::polyline)) {
      // Farther than an edge the range of pieces tells nothing; see bin_tool_edges.
      const auto nearest =
          kernels::nearest_on_surface((*tools.shapes)->surface_of(tool.value), (*range)(row, 0),
                                      (*range)(row, 1), rx, ry, farthest);
      m.nx = nearest.nx;
      m.ny = nearest.ny;
      m.gap = -nearest.distance;
    } else {
      m.nx = tools.normal(tool, 0);
      m.ny = tools.normal(tool, 1);
      m.gap = -(rx * m.nx + ry * m.ny);
    }
    return m;
  };
  const auto look_at = [&](const RowPair<ToolContact>& rows, LaneSums& sum) {
    std::array<const Shape::Edge*, 2> edge;
    std::array<std::size_t, 2> first;
    for (std::size_t i = 0; i < 2; ++i) {
      const int slot = columns.pair(rows[i], 0);
      edge[i] = &entry(bodies->shape_of_slot(slot).edges, columns.pair(rows[i], 1));
      const int control = entry(bodies->slots, slot).first_control;
      first[i] = 2 * static_cast<std::size_t>(control + edge[i]->first_control);
    }
    const PointLanes at = edge_points_at(points + first[0], points + first[1]);
    RowMotion m = gap_to(rows[0], at, edge[0]->length);
    const RowMotion other = gap_to(rows[1], at, edge[1]->length);
    const LaneMask low = LaneMask::of(15);
    m.nx = select(low, m.nx, other.nx);
    m.ny = select(low, m.ny, other.ny);
    m.gap = select(low, m.gap, other.gap);

    unsigned touching = 0;
    for (int i = 0; i < rows_in(rows); ++i) {
      const double deepest = greatest_of_half(m.gap, i);
      if (deepest > 0)
        touching |= 1U << i;
      else
        set_apart(columns, entry(rows, i), clock->travel - deepest);
    }
    if (touching == 0) return;
    m.gap_rate = m.slip_rate = Lane{};
    if (rates != nullptr) {
      const PointLanes speed = edge_points_at(rates + first[0], rates + first[1]);
      const Row<Tool> a(columns.pair(rows[0], 2)), b(columns.pair(rows[1], 2));
      const Lane wx = speed.x - halves(tool_velocity(a, 0), tool_velocity(b, 0));
      const Lane wy = speed.y - halves(tool_velocity(a, 1), tool_velocity(b, 1));
      m.gap_rate = -(wx * m.nx + wy * m.ny);
      m.slip_rate = wy * m.nx - wx * m.ny;
    }
    set_touching(columns, rows, touching, m, 1.0, clock->dt_before, sum);
  };
  for_active_pairs<ToolContact>(
      columns.pair.rows(), *sums,
      [&](Row<ToolContact> row) { return clock->travel >= columns.reach(row); },
      [&](Row<ToolContact> row) { fetch(columns, row); }, [](Row<ToolContact>) {}, look_at);
}

}  // namespace pulvis
