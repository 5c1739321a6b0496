// pressed_bonds: cold welding: points whose pressure has exceeded a threshold bond once it has dropped again.
//
// Law      strength = growth (largest pressure - threshold), up to the law's (systems/contact/new_bonds.hpp)
// Runs     before edge_contact, by the pressures of the previous step: edge_contact and bond_forces then agree in every
//          step on who handles a point, and none is counted twice
// Active   when the scene has bonds between particles that form under pressure
#include "systems/contact/new_bonds.hpp"

namespace pulvis {
namespace {

// The search for the closest point stops at a corner if the point is beyond it. It would be held beside its place there.
bool is_at_corner(const PackedCurvePoint& closest) {
  constexpr double rounding = 1e-11;
  const double u = closest.unpacked().u;
  return u == 0 || u > CurvePoint::last_u - rounding;
}

}  // namespace

void pressed_bonds::operator()(SmallTasks) const {
  for_rows<Contact>(rows.pair.rows(), [&](Row<Contact> row) {
    weld(rows, pressure, *rules, row, [&](int g) -> std::optional<BondOpening> {
      if (is_at_corner(at.closest(row, g))) return std::nullopt;
      at.anchor(row, g) = at.closest(row, g);
      return BondOpening{};  // measured from the surface
    });
  });
}

}  // namespace pulvis
