// The lever's own mesh: one layer, or a few, of hexahedra over a plan, and a coating on its back.
#pragma once

#include <memory>

#include "scenes/lever/mesh/solid_draft.hpp"
#include "scenes/spec/afm_scene.hpp"

namespace pulvis {

// A V as its drawing dimensions give it. The apex is where the outer edges would meet.
struct VOutline {
  double half_angle = 0;  // rad
  double apex = 0;        // m, from the clamp
  double inner = 0;       // m, from the clamp to where the inner edges meet
  double base_width = 0;  // m, over both arms at the clamp
};
VOutline v_outline(const LeverSpec& lever);

// Where a tip stands, and how small the elements have to be there.
struct LeverFoot {
  double x = 0, y = 0, size = 0;  // m
};
PlanMesh lever_plan(const LeverSpec& lever, const LeverFoot& foot);
// How many quads the plan of a beam or a V will have along and across it.
struct PlanCount {
  std::int64_t along = 0, across = 0;
};
PlanCount plan_count(const LeverSpec& lever, const LeverFoot& foot);

// A weighted mean of nodes: displacements are read there, forces put there.
using Gauge = std::vector<SolidMesh::Support>;

// A layer of the lever's nodes, seen from above.
struct LeverLevel {
  std::shared_ptr<const PlanMesh> plan;
  std::vector<int> node;  // [points of the plan] of the draft
  std::vector<double> z;  // [points of the plan] m
};
struct LeverMesh {
  std::vector<LeverLevel> levels;  // from the lower face up to the back

  struct Point {
    Gauge gauge;
    double z = 0;
  };
  // Above or below a point of the plan; nothing beside the lever.
  std::optional<Point> on(std::size_t level, const Vec2& point) const;
  std::optional<Point> on_lower_face(const Vec2& point) const { return on(0, point); }
  std::optional<Point> on_back(const Vec2& point) const { return on(levels.size() - 1, point); }
  // Where z = 0, between the two levels around it.
  std::optional<Point> on_middle(const Vec2& point) const;
};
// Puts the lever into an empty draft, clamped where x = 0.
LeverMesh add_lever(SolidDraft& draft, const LeverSpec& lever, const PlanMesh& plan);

}  // namespace pulvis
