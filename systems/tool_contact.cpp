// tool_contact: narrow phase between particles and rigid tools: the Gauss points of every candidate
// edge against the tool's surface, a plane or a polyline.
//
// Source   systems/contact_kernel.hpp; one pass with the full stiffness, since a tool is not sampled
// Runs     after bin_edges and tool_motion, before contact_force
// Active   when the scene has tools
#include <oneapi/tbb/parallel_for.h>

#include "systems/contact_row.hpp"
#include "systems/surface_kernel.hpp"
#include "systems/systems.hpp"

namespace pulvis {

void tool_contact(Read<Bodies> bodies, Read<Clock> clock, Read<CurvePosition> position,
                  Optional<Read<CurveVelocity>> velocity, Read<ToolPosition> tool_position,
                  Read<ToolVelocity> tool_velocity, Read<ToolNormal> tool_normal,
                  Write<ContactPair<ToolContact>> pair, Write<ContactReach<ToolContact>> reach,
                  Read<ContactStiffness<ToolContact>> stiffness,
                  Read<ContactWeight<ToolContact>> weight, Read<EdgeLength<ToolContact>> length,
                  Write<PointForce<ToolContact>> force, Write<Penetration<ToolContact>> penetration,
                  Write<ContactEnergy<ToolContact>> energy,
                  Optional<Read<FrictionCoefficient<ToolContact>>> friction,
                  Optional<Write<ElasticSlip<ToolContact>>> elastic_slip,
                  Optional<Write<FrictionWork<ToolContact>>> friction_work,
                  Optional<Read<DampingCoefficient<ToolContact>>> damping,
                  Optional<Write<DampingWork<ToolContact>>> damping_work,
                  Optional<Read<ToolShapes>> shapes, Optional<Read<SurfaceRange>> range) {
  const RowColumns<ToolContact> columns{
      pair,   reach,    stiffness,    weight,        length,  force,       penetration,
      energy, friction, elastic_slip, friction_work, damping, damping_work};
  const double* points = position.values().data();
  const double* rates = velocity ? velocity->values().data() : nullptr;

  const auto look_at = [&](Row<ToolContact> row) {
    if (clock->travel < reach(row)) return;
    const int slot = pair(row, 0);
    const Row<Tool> tool(pair(row, 2));
    const Shape::Edge& edge =
        bodies->shape_of_slot(slot).edges[static_cast<std::size_t>(pair(row, 1))];
    const int control = bodies->slots[static_cast<std::size_t>(slot)].first_control;
    const std::size_t first = 2 * static_cast<std::size_t>(control + edge.first_control);

    const PointLanes at = edge_points_at(points + first);
    RowMotion m{};
    if (range && (*shapes)->is(tool.value, ToolShapes::Kind::polyline)) {
      // Farther than an edge the range of pieces tells nothing; see bin_tool_edges.
      const auto nearest = kernels::nearest_on_surface(
          (*shapes)->surface_of(tool.value), (*range)(row, 0), (*range)(row, 1),
          at.x - tool_position(tool, 0), at.y - tool_position(tool, 1), edge.length);
      m.nx = nearest.nx;
      m.ny = nearest.ny;
      m.gap = -nearest.distance;
    } else {
      m.nx = broadcast(tool_normal(tool, 0));
      m.ny = broadcast(tool_normal(tool, 1));
      m.gap = -((at.x - tool_position(tool, 0)) * m.nx + (at.y - tool_position(tool, 1)) * m.ny);
    }
    if (!any(m.gap > 0.0)) return set_apart(columns, row, clock->travel - greatest(m.gap));
    if (rates != nullptr) {
      const PointLanes speed = edge_points_at(rates + first);
      const Lane wx = speed.x - tool_velocity(tool, 0), wy = speed.y - tool_velocity(tool, 1);
      m.gap_rate = -(wx * m.nx + wy * m.ny);
      m.slip_rate = wy * m.nx - wx * m.ny;
    }
    set_touching(columns, row, m, 1.0, clock->dt_before);
  };
  tbb::parallel_for(0, pair.rows(), [&](int row) { look_at(Row<ToolContact>(row)); });
}

}  // namespace pulvis
