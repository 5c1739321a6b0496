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
template <class D>
void tool_servo<D>::operator()() const {
  drive_tools(servos, [&](int tool) {
    TouchSum sums;
    for (int r = 0; r < rows.pair.rows(); ++r) {
      const Row<typename D::ToolContact> row(r);
      if (rows.touches(row) == 0 || rows.pair(row, 2) != tool) continue;
      sums.add(touching_of(bodies, row, rows, law, servos.rules->stiffest_weld()));
    }
    return sums.of_ranks(link);
  });
}
template struct tool_servo<TwoD>;
template struct tool_servo<ThreeD>;

}  // namespace pulvis
