#include "scenes/contact_search.hpp"

#include <algorithm>

#include "components/bond.hpp"
#include "scenes/tools/bond_rules.hpp"

namespace pulvis {

void add_bond_totals(World& world, const Scene& scene) {
  if (!has_bonds(scene)) return;
  BondTotals& totals = world.emplace<BondTotals>();
  totals.made.assign(scene.bonds.size(), 0);
  totals.nearest.resize(scene.bonds.size());
}

void set_reach(ContactIndex& index, const Scene& scene, const ContactRules& rules, double bonds) {
  // Surfaces must move by this many skins relative to each other before non-neighbours can come close: more than
  // neighbours move, and few enough to keep lists short.
  constexpr double skins_of_neighbourhood = 8;
  index.skin = scene.contact.skin * rules.shortest_edge;
  index.reach = std::max(bonds, rules.reach);
  index.neighbourhood = skins_of_neighbourhood * index.skin + index.reach;
}

}  // namespace pulvis
