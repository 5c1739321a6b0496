// element_health: stops a run with inverted or NaN elements.
//
// Runs     every step, after the forces
#include <fmt/format.h>

#include <algorithm>

#include "components/run_state.hpp"
#include "engine/access.hpp"
#include "engine/entry.hpp"
#include "engine/run_failure.hpp"
#include "systems/body/systems.hpp"

namespace pulvis {

void element_health::operator()() const {
  bodies->for_own_lanes([&](int slot) {
    const double value = entry(worst.value.values(), slot);
    totals->min_jacobian = std::min(totals->min_jacobian, value);
    if (value > 0) return;  // false for NaN
    throw RunFailure(fmt::format(
        "element_health: particle {}, element {}: det F = {:.6g} at step {}, t = {:.6g} s: the "
        "element turned inside out; allowed > 0 (is a tool too fast, or the mesh too coarse for "
        "the load?)",
        entry(bodies->slots, slot).number, static_cast<int>(entry(worst.element.values(), slot)),
        value, clock->step, clock->time));
  });
}

}  // namespace pulvis
