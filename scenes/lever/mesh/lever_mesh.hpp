// The lever's mesh: one or more layers of hexahedra over a plan, more of them around the tip's foot, and a
// coating on its back.
#pragma once

#include <memory>

#include "scenes/lever/mesh/lever_plan.hpp"
#include "scenes/lever/mesh/solid_draft.hpp"

namespace pulvis {

// A weighted mean of nodes: used to read displacements and to apply forces.
using Gauge = std::vector<SolidMesh::Support>;

// A layer of the lever's nodes, seen from above.
struct LeverLevel {
  std::shared_ptr<const PlanMesh> plan;
  std::vector<int> node;  // [points of the plan] node of the draft; -1: none
  std::vector<double> z;  // [points of the plan] m
};
struct LeverMesh {
  std::vector<LeverLevel> levels;  // from the lower face up to the back

  struct Point {
    Gauge gauge;
    double z = 0;
  };
  // The point above or below a point of the plan; empty outside the lever.
  std::optional<Point> on(std::size_t level, const Vec2& point) const;
  std::optional<Point> on_lower_face(const Vec2& point) const { return on(0, point); }
  std::optional<Point> on_back(const Vec2& point) const { return on(levels.size() - 1, point); }
  // The point at z = 0, interpolated between the two levels around it.
  std::optional<Point> on_middle(const Vec2& point) const;
};
// Adds the lever to an empty draft, clamped at x = 0.
LeverMesh add_lever(SolidDraft& draft, const LeverSpec& lever, const LeverPlan& plan,
                    double foot_edge);
// Number of solid elements through the thickness around the foot, without the coating.
int foot_layers(const LeverSpec& lever, double foot_edge);

}  // namespace pulvis
