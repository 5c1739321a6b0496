// return_health: stops a run if a return mapping found no stress on the yield surface.
//
// Runs     every step, after the forces
// Active   when a material hardens nonlinearly or is rate-dependent: the return is then iterative
#include <fmt/format.h>

#include "engine/entry.hpp"
#include "engine/run_failure.hpp"
#include "systems/body/systems.hpp"

namespace pulvis {

void return_health::operator()() const {
  const auto values = residual.values();  // per chunk: eight residuals, eight elements
  bodies->for_own_lanes([&](int slot) {
    const int at = slot / lane_count * 2 * lane_count + slot % lane_count;
    if (entry(values, at) == 0) return;  // false for NaN
    throw RunFailure(fmt::format(
        "j2_return_map: particle {}, element {}: the stress deviates from the flow stress by "
        "{:.3g} of it at step {}, t = {:.6g} s; allowed 0: the return mapping did not converge (is "
        "the law of its material "
        "finite at this strain?)",
        entry(bodies->slots, slot).number, static_cast<int>(entry(values, at + lane_count)),
        entry(values, at), clock->step, clock->time));
  });
}

}  // namespace pulvis
