// contact_totals: sums of the contact rows.
//
// Runs     every step, since dissipation adds up over steps
#include <cmath>

#include "components/run_state.hpp"
#include "engine/access.hpp"
#include "systems/contact/systems.hpp"

namespace pulvis {

namespace {

BlockSums sum_of(const std::vector<BlockSums>& blocks) {
  BlockSums sum;
  for (const BlockSums& block : blocks) {
    sum.touching += block.touching;
    sum.energy += block.energy;
    sum.friction_work += block.friction_work;
    sum.damping_work += block.damping_work;
    sum.projections += block.projections;
    sum.unconverged += block.unconverged;
  }
  return sum;
}

}  // namespace

// Damping by the trapezoidal rule, like the work of the tools: the forces at both ends of the step times its displacement,
// so that none is booked before the first touch. The force before times the rate now is, of a linear damper, the
// geometric mean of both powers.
void contact_totals::operator()() const {
  const BlockSums of_pairs = pairs ? sum_of((*pairs)->blocks) : BlockSums{};
  const BlockSums of_tools = tools ? sum_of((*tools)->blocks) : BlockSums{};
  totals->touching = of_pairs.touching + of_tools.touching;
  totals->contact_energy = of_pairs.energy + of_tools.energy;
  totals->friction_work += of_pairs.friction_work;
  totals->friction_work += of_tools.friction_work;
  totals->projections += of_pairs.projections;
  totals->unconverged += of_pairs.unconverged;
  const double dt = clock->dt_before;
  const double power = dt > 0 ? (of_pairs.damping_work + of_tools.damping_work) / dt : 0;
  totals->damping_work += 0.5 * (std::sqrt(totals->damping_power * power) + power) * dt;
  totals->damping_power = power;
}

}  // namespace pulvis
