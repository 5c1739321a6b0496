// tool_servo: speed in the next step of tools that hold a force, from the force they currently carry.
//
// Source   systems/tools/servo_kernel.hpp
// Runs     after tool_reaction; tool_motion adds the displacement in the next step
// Active   when a stage of the scene has a servo, or an elastic drive
// Watches  that the force is reached when its stage ends; that the mass on a spring suffices for the time step
#include "components/contact.hpp"
#include "engine/access.hpp"
#include "systems/tools/servo_motion.hpp"
#include "systems/tools/servo_touch.hpp"
#include "systems/tools/systems.hpp"

namespace pulvis {
namespace {

kernels::TouchSums touching(int tool, const TouchingRows<ToolContact>& rows,
                            const Read<ContactLaw<ToolContact>>& law, double bonds,
                            const Link& link) {
  TouchSum sums;
  for (int r = 0; r < rows.pair.rows(); ++r) {
    const Row<ToolContact> row(r);
    if (rows.touches(row) == 0 || rows.pair(row, 2) != tool) continue;
    sums.add(touching_of(row, rows, law, bonds));
  }
  return sums.of_ranks(link);
}

}  // namespace

void tool_servo::operator()() const {
  drive_tools(servos, [&](int tool) {
    return touching(tool, rows, law, servos.rules->stiffest_weld(), link);
  });
}

}  // namespace pulvis
