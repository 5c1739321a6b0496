// The lever's own mesh: one layer, or a few, of hexahedra over a plan, more of them around the tip's foot, and a
// coating on its back.
#pragma once

#include <memory>

#include "scenes/lever/mesh/lever_plan.hpp"
#include "scenes/lever/mesh/solid_draft.hpp"

namespace pulvis {

// A weighted mean of nodes: displacements are read there, forces put there.
using Gauge = std::vector<SolidMesh::Support>;

// A layer of the lever's nodes, seen from above.
struct LeverLevel {
  std::shared_ptr<const PlanMesh> plan;
  std::vector<int> node;  // [points of the plan] of the draft; -1: none there
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
LeverMesh add_lever(SolidDraft& draft, const LeverSpec& lever, const LeverPlan& plan,
                    double foot_edge);
// Of solid elements through the thickness around the foot, without the coating.
int foot_layers(const LeverSpec& lever, double foot_edge);

}  // namespace pulvis
