// ridge_health: stops a run in which a ridge or corner of a polyline passes through a particle where the contact
// does not detect it: contact is evaluated at Gauss points of outlines, and directed by the nearest flank.
//
// Law      A point that is deeper in a ridge than a share of its thickness is about to leave it on the other
//          side. A corner of the tool that is inside an outline by more than `limits.penetration` of an edge has
//          entered between its Gauss points.
// Runs     after the narrow phase; corners when the rows are rebuilt, which is before surfaces have moved
//          by more than the skin
// Active   when a tool is a polyline
#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "engine/entry.hpp"
#include "engine/portable_math.hpp"
#include "engine/run_failure.hpp"
#include "systems/contact/broad_phase.hpp"
#include "systems/contact/contact_kernel.hpp"
#include "systems/contact/surface_search.hpp"
#include "systems/tools/surface_kernel.hpp"
#include "systems/tools/systems.hpp"

namespace pulvis {
namespace {

// A point can be at most half the thickness deep. It moves by less than a quarter per step (advance_clock),
// so that none can cross the middle between two steps.
constexpr double deepest_share = 0.3;

// ---- flanks -----------------------------------------------------------------------------------------
Point curve_point(const double* control, double u) {
  const auto n = kernels::basis(u);
  Point p{};
  for (std::size_t a = 0; a < 4; ++a)
    for (std::size_t k = 0; k < 2; ++k) p[k] += n[a] * control[2 * a + k];
  return p;
}

// Over the points of a row.
double deepest_in(const ToolSurface& surface, const Point& at, const double* control, double length,
                  int first, int last) {
  double deepest = 0;
  for (const double u : kernels::edge_u) {
    const Point p = curve_point(control, u);
    const auto nearest =
        kernels::nearest_on_surface(surface, first, last, p[0] - at[0], p[1] - at[1], length);
    deepest = std::max(deepest, -nearest.distance);
  }
  return deepest;
}

// ---- corners ----------------------------------------------------------------------------------------
// Outermost point of a corner, in the tool's frame.
Point tip_of(const ToolSurface::Piece& p) {
  const double nx = -p.ty - p.next_ty, ny = p.tx + p.next_tx, length = portable::hypot(nx, ny);
  return {p.corner_x + p.radius * nx / length, p.corner_y + p.radius * ny / length};
}

// Depth of a point in an outline, over the length of the nearest edge; 0 outside. Chords instead of curves:
// accurate enough for anything deeper than contacts get.
struct Depth {
  double distance = 0, share = 0;
};
Depth depth_in(const Shape& shape, const double* control, const Point& p) {
  bool inside = false;
  double minimum = std::numeric_limits<double>::infinity(), length = 1;
  for (const Shape::Edge& edge : shape.edges) {
    const double* y = control + 2 * edge.first_control;
    const Point a = curve_point(y, 0), b = curve_point(y, 1);
    if ((a[1] > p[1]) != (b[1] > p[1]) &&
        p[0] < a[0] + (p[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]))
      inside = !inside;
    const double cx = b[0] - a[0], cy = b[1] - a[1], rx = p[0] - a[0], ry = p[1] - a[1];
    const double share = std::clamp((rx * cx + ry * cy) / (cx * cx + cy * cy), 0.0, 1.0);
    const double distance = portable::hypot(rx - share * cx, ry - share * cy);
    if (distance >= minimum) continue;
    minimum = distance;
    length = edge.length;
  }
  return inside ? Depth{minimum, minimum / length} : Depth{};
}

Box in_frame_of(Box box, const Point& tool) {
  for (std::size_t k = 0; k < 2; ++k) {
    box.low[k] -= tool[k];
    box.high[k] -= tool[k];
  }
  return box;
}

// ---- failures ------------------------------------------------------------------------------------------
struct Scenery {
  const Bodies& bodies;
  const Clock& clock;
  const ContactRules& rules;
  const double* control;
  const Read<ToolPosition>& position;
  const ToolShapes& shapes;
  const ToolProgram& program;

  const double* outline(int slot) const {
    return control + 2 * entry(bodies.slots, slot).first_control;
  }
  Point tool_at(int tool) const {
    return {position(Row<Tool>(tool), 0), position(Row<Tool>(tool), 1)};
  }
  [[noreturn]] void stop(int slot, int tool, const std::string& what) const {
    throw RunFailure(
        fmt::format("ridge_health: particle {} and tool '{}': {} (step {}, t = {:.6g} s)",
                    entry(bodies.slots, slot).number, entry(program.names, tool), what, clock.step,
                    clock.time));
  }
};

void check_flanks(const Scenery& s, const ridge_health::Rows& rows) {
  for (int r = 0; r < rows.pair.rows(); ++r) {
    const Row<ToolContact> row(r);
    if (rows.touches(row) == 0) continue;
    const int slot = rows.pair(row, 0), tool = rows.pair(row, 2);
    const double thickness = entry(s.rules.tool_thickness, tool);
    if (std::isinf(thickness)) continue;
    const Shape::Edge& edge = entry(s.bodies.shape_of_slot(slot).edges, rows.pair(row, 1));
    const double depth = deepest_in(s.shapes.surface_of(tool), s.tool_at(tool),
                                    s.outline(slot) + 2 * edge.first_control, edge.length,
                                    rows.range(row, 0), rows.range(row, 1));
    if (depth <= deepest_share * thickness) continue;
    s.stop(
        slot, tool,
        fmt::format(
            "a ridge {:.6g} m thick is penetrated by {:.6g} m; allowed {:.6g} m: beyond that, the "
            "particle would emerge on the other side (use stiffer contacts or a thicker ridge)",
            thickness, depth, deepest_share * thickness));
  }
}

void check_corners(const Scenery& s, int slot, int tool) {
  const ToolSurface& surface = s.shapes.surface_of(tool);
  const Shape& shape = s.bodies.shape_of_slot(slot);
  const Point at = s.tool_at(tool);
  const Box box = in_frame_of(box_of(s.outline(slot), shape.control_points()), at);
  const PieceRange range = pieces_near(surface, box, 0);
  for (int i = range.first; i <= range.last; ++i) {
    const ToolSurface::Piece& piece = entry(surface.pieces, i);
    if (piece.side <= 0) continue;
    const Point tip = tip_of(piece);
    if (!near(box, {{tip[0], tip[1]}, {tip[0], tip[1]}}, 0)) continue;
    const Depth depth = depth_in(shape, s.outline(slot), {at[0] + tip[0], at[1] + tip[1]});
    if (depth.share <= s.rules.penetration_limit) continue;
    s.stop(
        slot, tool,
        fmt::format("the tool's corner at ({:.6g}, {:.6g}) m is {:.6g} m, {:.3g} edges, inside the "
                    "outline, between its Gauss points; allowed {:.3g} (limits.penetration; use a "
                    "finer mesh or a rounder corner)",
                    at[0] + tip[0], at[1] + tip[1], depth.distance, depth.share,
                    s.rules.penetration_limit));
  }
}

}  // namespace

void ridge_health::operator()() const {
  const Scenery scenery{*bodies,        *clock,        *rules,        curve.values().data(),
                        tools.position, *tools.shapes, *tools.program};
  check_flanks(scenery, rows);
  if (!index->due) return;
  for (const int slot : bodies->own_slots)
    for (int tool = 0; tool < tools.position.rows(); ++tool)
      if (tools.shapes->is(tool, ToolShapes::Kind::polyline)) check_corners(scenery, slot, tool);
}

}  // namespace pulvis
