// pressed_bonds: cold welding: points whose pressure has exceeded a threshold bond once it has dropped again.
//
// Law      strength = growth (largest pressure - threshold), up to the law's (systems/contact/new_bonds.hpp)
// Runs     before edge_contact, by the pressures of the previous step: edge_contact and bond_forces then agree in every
//          step on who handles a point, and none is counted twice
// Active   when the scene has bonds between particles that form under pressure
#include "systems/contact/new_bonds.hpp"

namespace pulvis {

void pressed_bonds::operator()(SmallTasks) const {
  for_rows<Contact>(rows.pair.rows(), [&](Row<Contact> row) {
    weld(rows, pressure, *rules, row, [&](int g) {
      at.anchor(row, g) = at.closest(row, g);
      return BondOpening{};  // measured from the surface
    });
  });
}

}  // namespace pulvis
