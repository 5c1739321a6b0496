// contact_totals: sums over the contact rows.
//
// Runs     every step, since dissipation accumulates over steps
#include <array>
#include <cmath>

#include "components/run_state.hpp"
#include "engine/access.hpp"
#include "systems/contact/systems.hpp"

namespace pulvis {

namespace {

// Over all blocks of all ranks.
struct Sums {
  enum Exact { energy, friction_work, damping_work, indentation_work, exact };
  enum Count { touching, projections, unconverged, counts };
  std::array<ExactSum, exact> sum;
  std::array<std::int64_t, counts> count{};

  void add(const std::vector<BlockSums>& blocks) {
    for (const BlockSums& block : blocks) {
      sum[energy].add(block.energy);
      sum[friction_work].add(block.friction_work);
      sum[damping_work].add(block.damping_work);
      sum[indentation_work].add(block.indentation_work);
      count[touching] += block.touching;
      count[projections] += block.projections;
      count[unconverged] += block.unconverged;
    }
  }
};

}  // namespace

// Damping by the trapezoidal rule, like the work of the tools: the forces at both ends of the step times its displacement,
// so that none is counted before first contact. The previous force times the current rate is, for a linear damper, the
// geometric mean of both powers.
void contact_totals::operator()() const {
  Sums of;
  if (pairs) of.add((*pairs)->blocks);
  if (tools) of.add((*tools)->blocks);
  sum_of_ranks(link, of.sum, of.count);
  totals->touching = of.count[Sums::touching];
  totals->contact_energy = of.sum[Sums::energy].value();
  totals->friction_work += of.sum[Sums::friction_work].value();
  totals->indentation_work += of.sum[Sums::indentation_work].value();
  totals->projections += of.count[Sums::projections];
  totals->unconverged += of.count[Sums::unconverged];
  const double dt = clock->dt_before;
  const double power = dt > 0 ? of.sum[Sums::damping_work].value() / dt : 0;
  totals->damping_work += 0.5 * (std::sqrt(totals->damping_power * power) + power) * dt;
  totals->damping_power = power;
}

}  // namespace pulvis
