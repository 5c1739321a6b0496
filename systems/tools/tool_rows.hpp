// Positions of the Gauss points of tool candidates relative to their tools: for the narrow phase and the bonds.
#pragma once

#include "engine/entry.hpp"
#include "systems/laws/normal_contact.hpp"
#include "systems/tools/systems.hpp"
#include "systems/tools/tool_projection.hpp"

namespace pulvis {

// The sampled edges of two candidates.
struct SampledEdges {
  std::array<double, 2> length;               // m
  std::array<std::int32_t, 2> first_control;  // of all

  static SampledEdges of(const Bodies& bodies, const Read<ContactPair<ToolContact>>& pair,
                         const TwoCandidates<ToolContact>& two) {
    SampledEdges edges;
    for (int i = 0; i < 2; ++i) {
      const int slot = pair(entry(two, i), 0);
      const Shape::Edge& edge = entry(bodies.shape_of_slot(slot).edges, pair(entry(two, i), 1));
      entry(edges.length, i) = edge.length;
      entry(edges.first_control, i) = entry(bodies.slots, slot).first_control + edge.first_control;
    }
    return edges;
  }
  kernels::Hardness<Lane> hardness(const Read<SurfaceHardness<TwoD>>& of) const {
    const Row<ControlPoint> a(first_control[0]), b(first_control[1]);
    using Number = SurfaceHardness<TwoD>;
    return {halves(of(a, Number::pressure), of(b, Number::pressure)),
            halves(of(a, Number::left), of(b, Number::left))};
  }
  PointLanes points(const double* list) const {
    return edge_points_at(list + 2 * first_control[0], list + 2 * first_control[1]);
  }
};

// For all points, as if both candidates had this candidate's tool.
inline PointMotion gap_to_tool(const ToolSurfaces& tools, const Optional<Read<SurfaceRange>>& range,
                               Row<ToolContact> row, int number, const PointLanes& at,
                               double farthest) {
  const Row<Tool> tool(number);
  const Point stands{tools.position(tool, 0), tools.position(tool, 1)};
  // Beyond one edge length the range of pieces says nothing; see bin_tool_edges.
  if (range && (*tools.shapes)->is(number, ToolShapes::Kind::polyline))
    return project_on_polyline(stands, (*tools.shapes)->surface_of(number), (*range)(row, 0),
                               (*range)(row, 1), at, farthest);
  return project_on_plane(stands, {tools.normal(tool, 0), tools.normal(tool, 1)}, at);
}

}  // namespace pulvis
