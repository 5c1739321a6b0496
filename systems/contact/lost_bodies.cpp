// lost_bodies: a particle whose centre is behind a plane tool has passed through it, however generous the scene's
// penetration limit is. Polylines are excluded: they have ends, and particles may be beside them.
//
// Runs     on sampled steps
// Active   when the scene has tools that can touch
#include <fmt/format.h>

#include "engine/entry.hpp"
#include "engine/run_failure.hpp"
#include "systems/contact/systems.hpp"

namespace pulvis {
namespace {

// Mean of the contact curve's control points.
Point middle_of(const Bodies& bodies, int slot, const Read<CurvePosition>& curve) {
  const int first = entry(bodies.slots, slot).first_control;
  const int count = bodies.shape_of_slot(slot).control_points();
  Point middle{};
  for (int i = first; i < first + count; ++i)
    for (int k = 0; k < 2; ++k) entry(middle, k) += curve(Row<ControlPoint>(i), k) / count;
  return middle;
}

}  // namespace

void lost_bodies::operator()() const {
  for (const int slot : bodies->own_slots) {
    const Point middle = middle_of(*bodies, slot, curve);
    for (int t = 0; t < tools.position.rows(); ++t) {
      if (!tools.is(t, ToolShapes::Kind::plane)) continue;
      const Row<Tool> tool(t);
      const double height = (middle[0] - tools.position(tool, 0)) * tools.normal(tool, 0) +
                            (middle[1] - tools.position(tool, 1)) * tools.normal(tool, 1);
      if (height >= 0) continue;
      throw RunFailure(fmt::format(
          "lost_bodies: particle {} has gone through tool '{}': its centre is {:.6g} m behind it "
          "at step {}, t = {:.6g} s; allowed: in front of it",
          entry(bodies->slots, slot).number, entry(program->names, t), -height, clock->step,
          clock->time));
    }
  }
}

}  // namespace pulvis
