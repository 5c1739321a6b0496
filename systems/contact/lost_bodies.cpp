// lost_bodies: a particle whose middle is behind a plane tool has gone through it, however wide the scene has set
// its limit of penetration. Polylines are left out: they have ends, and particles may be beside them.
//
// Runs     on sampled steps
// Active   when the scene has tools that touch
#include "systems/contact/lost_bodies.hpp"

#include <fmt/format.h>

#include "engine/run_failure.hpp"

namespace pulvis {
namespace {

bool is_plane(const Optional<Read<ToolShapes>>& shapes, int tool) {
  return !shapes || (*shapes)->is(tool, ToolShapes::Kind::plane);
}

// Mean of the contact curve's control points.
Point middle_of(const Bodies& bodies, int slot, const Read<CurvePosition>& curve) {
  const int first = bodies.slots[static_cast<std::size_t>(slot)].first_control;
  const int count = bodies.shape_of_slot(slot).control_points();
  Point middle{};
  for (int i = first; i < first + count; ++i)
    for (int k = 0; k < 2; ++k)
      middle[static_cast<std::size_t>(k)] += curve(Row<ControlPoint>(i), k) / count;
  return middle;
}

}  // namespace

void lost_bodies(Read<Bodies> bodies, Read<Clock> clock, Read<ToolProgram> program,
                 Read<ToolPosition> position, Read<ToolNormal> normal,
                 Optional<Read<ToolShapes>> shapes, Read<CurvePosition> curve) {
  for (const int slot : bodies->slot_of_number) {
    const Point middle = middle_of(*bodies, slot, curve);
    for (int t = 0; t < position.rows(); ++t) {
      if (!is_plane(shapes, t)) continue;
      const Row<Tool> tool(t);
      const double height = (middle[0] - position(tool, 0)) * normal(tool, 0) +
                            (middle[1] - position(tool, 1)) * normal(tool, 1);
      if (height >= 0) continue;
      throw RunFailure(fmt::format(
          "lost_bodies: particle {} has gone through tool '{}': its middle is {:.6g} m behind it "
          "at step {}, t = {:.6g} s; allowed: in front of it",
          bodies->slots[static_cast<std::size_t>(slot)].number,
          program->names[static_cast<std::size_t>(t)], -height, clock->step, clock->time));
    }
  }
}

}  // namespace pulvis
