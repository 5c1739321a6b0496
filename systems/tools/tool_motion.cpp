// tool_motion: programmed tool positions at t_n, and their mean velocity over the last step.
#include "components/contact.hpp"
#include "components/run_state.hpp"
#include "components/servo.hpp"
#include "engine/access.hpp"
#include "engine/entry.hpp"
#include "systems/tools/systems.hpp"
#include "systems/tools/tool_kernel.hpp"

namespace pulvis {

Point3 tool_position_at(const ToolProgram& program, int tool, double time) {
  Point3 at = entry(program.start, tool);
  for (const ToolProgram::Segment& s : program.segments) {
    if (s.tool != tool) continue;
    const double share =
        kernels::cut_travel((time - s.begin) / s.duration, s.ramp, (s.cut - s.begin) / s.duration);
    for (std::size_t k = 0; k < tool_axes; ++k) at[k] += share * s.displacement[k];
  }
  return at;
}

void tool_motion::operator()() const {
  for (int t = 0; t < position.rows(); ++t) {
    const Row<Tool> tool(t);
    const Point3 now = tool_position_at(*program, t, clock->time);
    const Point3 before = tool_position_at(*program, t, clock->time - clock->dt_before);
    for (int k = 0; k < tool_axes; ++k) {
      const double moved = entry(now, k) - entry(before, k);
      velocity(tool, k) = clock->dt_before > 0 ? moved / clock->dt_before : 0;
      position(tool, k) = entry(now, k);
      if (!servo) continue;
      (*servo_travel)(tool, k) += (*servo)(tool, k) * clock->dt_before;
      velocity(tool, k) += (*servo)(tool, k);
      position(tool, k) += (*servo_travel)(tool, k);
    }
  }
}

}  // namespace pulvis
