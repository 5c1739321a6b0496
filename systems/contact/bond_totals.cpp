// bond_totals: sums of the bonds, and what broke.
//
// Runs     every step, after bond_forces and contact_totals: what is spent adds up over steps
// Active   when the scene has bonds
#include <array>

#include "components/run_state.hpp"
#include "systems/contact/systems.hpp"

namespace pulvis {

void bond_totals::operator()() const {
  enum { energy, contact_energy, fracture, area, friction_work, damping_work, sums };
  std::array<ExactSum, sums> of;
  const auto take = [&](const std::vector<BondBlock>& blocks) {
    for (const BondBlock& block : blocks) {
      of[energy].add(block.energy);
      of[contact_energy].add(block.contact_energy);
      of[fracture].add(block.fracture);
      of[area].add(block.area);
      of[friction_work].add(block.friction_work);
      of[damping_work].add(block.damping_work);
      totals->touching += block.rows;
      for (const Crack& crack : block.cracks) {
        bonds->crack_length += crack.length;
        bonds->cracks.push_back(crack);
      }
    }
  };
  if (pairs) take((*pairs)->blocks);
  if (tools) take((*tools)->blocks);
  bonds->energy = of[energy].value();
  bonds->fracture += of[fracture].value();
  bonds->area = of[area].value();
  totals->contact_energy += of[contact_energy].value();
  totals->friction_work += of[friction_work].value();
  totals->damping_work += of[damping_work].value();
}

}  // namespace pulvis
