// The lever's own mesh: one layer, or a few, of hexahedra over a plan, and a coating on its back.
#pragma once

#include "scenes/afm_scene.hpp"
#include "scenes/solid_draft.hpp"

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

struct LeverMesh {
  PlanMesh plan;
  std::vector<double> levels;  // m, z of the layers of nodes, from the lower face up
  // Node of the draft above a point of the plan.
  int node(int point, std::size_t level) const {
    return static_cast<int>(level * plan.points.size()) + point;
  }
};
// Puts the lever into an empty draft, clamped where x = 0.
LeverMesh add_lever(SolidDraft& draft, const LeverSpec& lever, PlanMesh plan);

}  // namespace pulvis
