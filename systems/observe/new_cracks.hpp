// The broken share of every particle's bonds: counts the cracks since the last observation. Welds do not count.
#pragma once

#include "components/body.hpp"
#include "components/bond.hpp"

namespace pulvis {

inline void count_new_cracks(const Bodies& bodies, const BondRules& rules, const BondTotals& totals,
                             Fragments& found) {
  const auto number_of = [&](int slot) { return entry(bodies.slots, slot).number; };
  for (; found.counted < std::ssize(totals.cracks); ++found.counted) {
    const Crack& crack = entry(totals.cracks, found.counted);
    if (rules.law(crack.law).pressed()) continue;
    entry(found.broken, number_of(crack.slot)) += crack.size;
    if (crack.other >= 0) entry(found.broken, number_of(crack.other)) += crack.size;
  }
}

}  // namespace pulvis
