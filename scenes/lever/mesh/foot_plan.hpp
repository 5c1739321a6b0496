// Where a tip is attached to its lever, and the element layout there: both share the grid lines.
#pragma once

#include <optional>

#include "scenes/lever/mesh/plan_mesh.hpp"
#include "scenes/spec/afm_scene.hpp"

namespace pulvis {

// Where the tip is attached to the lever, in the plan.
Vec2 tip_axis(const LeverSpec& lever, const TipSpec& tip);
// Half the foot's width, or its radius: this area must lie on the lever.
double foot_reach(const TipSpec& tip);

struct FootPlan {
  Vec2 axis = Vec2::Zero();  // m
  double reach = 0;          // m, half its width, or its radius
  double edge = 0;           // m, of the elements at its rim
  double spacing = 0;        // -, of the outermost lines, as a share of half their box
  bool round = false;
  std::vector<double> lines;  // for a square foot: from -1 to 1, closer at the rim
  PlanMesh unit;              // the tip's mesh, from -1 to 1; empty for a tip from a file

  int across() const { return static_cast<int>(lines.size()) - 1; }
};
// Empty without a tip.
std::optional<FootPlan> foot_plan(const LeverSpec& lever, const TipSpec& tip);

}  // namespace pulvis
