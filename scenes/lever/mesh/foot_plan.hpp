// Where a tip stands on its lever, and how the elements of both lie there: the same lines in both.
#pragma once

#include <optional>

#include "scenes/lever/mesh/plan_mesh.hpp"
#include "scenes/spec/afm_scene.hpp"

namespace pulvis {

// Where the tip stands on the lever, in the plan.
Vec2 tip_axis(const LeverSpec& lever, const TipSpec& tip);
// Half the foot's width, or its radius: what must lie on the lever.
double foot_reach(const TipSpec& tip);

struct FootPlan {
  Vec2 axis = Vec2::Zero();  // m
  double reach = 0;          // m, half its width, or its radius
  double edge = 0;           // m, of the elements at its rim
  double spacing = 0;        // -, of the outermost lines, of half their box
  bool round = false;
  std::vector<double> lines;  // of a square: from -1 to 1, closer at the rim
  PlanMesh unit;              // the tip's own, -1 to 1 wide; of a tip from a file: empty

  int across() const { return static_cast<int>(lines.size()) - 1; }
};
// Nothing without a tip.
std::optional<FootPlan> foot_plan(const LeverSpec& lever, const TipSpec& tip);

}  // namespace pulvis
