// element_health: stops a run whose elements turned inside out or went NaN.
//
// Runs     every step, after the forces
#include <fmt/format.h>

#include <algorithm>

#include "components/run_state.hpp"
#include "engine/access.hpp"
#include "engine/run_failure.hpp"
#include "systems/body/systems.hpp"

namespace pulvis {

void element_health::operator()() const {
  const auto values = worst.value.values();
  for (std::size_t slot = 0; slot < values.size(); ++slot) {
    totals->min_jacobian = std::min(totals->min_jacobian, values[slot]);
    if (values[slot] > 0) continue;  // NaN is not
    throw RunFailure(fmt::format(
        "element_health: particle {}, element {}: det F = {:.6g} at step {}, t = {:.6g} s: the "
        "element turned inside out; allowed > 0 (is a tool too fast, or the mesh too coarse for "
        "the load?)",
        bodies->slots[slot].number, static_cast<int>(worst.element.values()[slot]), values[slot],
        clock->step, clock->time));
  }
}

}  // namespace pulvis
