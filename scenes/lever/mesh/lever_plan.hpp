// The plan of a beam or a V: quads, refined at the free sides, where a strip about as wide as the lever is
// thick carries the torsion, and around the tip's foot.
#pragma once

#include "scenes/lever/mesh/foot_plan.hpp"

namespace pulvis {

// A V given by its drawing dimensions. The apex is where the outer edges would meet.
struct VOutline {
  double half_angle = 0;  // rad
  double apex = 0;        // m, from the clamp
  double inner = 0;       // m, from the clamp to where the inner edges meet
  double base_width = 0;  // m, over both arms at the clamp
};
VOutline v_outline(const LeverSpec& lever);

struct LeverPlan {
  PlanMesh mesh;
  std::vector<bool> solid;  // [quads] around the foot, where plate elements are inadequate
};
LeverPlan lever_plan(const LeverSpec& lever, const std::optional<FootPlan>& foot);

// Number of quads along and across the lever, and around the foot.
struct PlanCount {
  double along = 0, across = 0, solid_along = 0, solid_across = 0;
};
PlanCount plan_count(const LeverSpec& lever, const std::optional<FootPlan>& foot);
// The range in which `aspect` affects the mesh.
struct AspectRange {
  double least = 0, most = 0;
};
AspectRange aspect_range(const LeverSpec& lever);

}  // namespace pulvis
