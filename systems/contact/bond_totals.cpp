// bond_totals: sums of the bonds, and what broke.
//
// Runs     every step, after bond_forces and contact_totals: what is spent adds up over steps
// Active   when the scene has bonds
#include "components/run_state.hpp"
#include "systems/contact/systems.hpp"

namespace pulvis {

void bond_totals::operator()() const {
  bonds->energy = bonds->area = 0;
  const auto take = [&](const std::vector<BondBlock>& blocks) {
    for (const BondBlock& block : blocks) {
      bonds->energy += block.energy;
      totals->contact_energy += block.contact_energy;
      bonds->fracture += block.fracture;
      bonds->area += block.area;
      totals->friction_work += block.friction_work;
      totals->damping_work += block.damping_work;
      totals->touching += block.rows;
      for (const Crack& crack : block.cracks) {
        bonds->crack_length += crack.length;
        bonds->cracks.push_back(crack);
      }
    }
  };
  if (pairs) take((*pairs)->blocks);
  if (tools) take((*tools)->blocks);
}

}  // namespace pulvis
