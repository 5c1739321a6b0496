// Bond creation: what initial_bonds and pressed_bonds set at a point. Shared by pairs of particles and tools.
#pragma once

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <optional>

#include "systems/contact/bond_strength.hpp"
#include "systems/contact/systems.hpp"

namespace pulvis {

struct BondOpening {
  double normal = 0, along = 0;  // m, at bond creation
};

template <class At>
void make_bond(const NewBonds<At>& rows, Row<At> row, int g, int law, double strength,
               const BondOpening& opening) {
  rows.law(row, BondLawNumber<At>::bonded) = static_cast<std::uint8_t>(law);
  rows.points(row) = static_cast<std::uint8_t>(rows.points(row) | 1U << g);
  rows.strength(row, g) = strength;
  rows.offset(row, g) = opening.normal;
  rows.offset(row, edge_points + g) = opening.along;
}

// ---- by pressure ------------------------------------------------------------------------------------
// Tracks the pressure of a row's points and welds those whose pressure has dropped. `anchor(g)` sets where point g is
// held, and returns its position relative to it; none if the point is no longer opposite the surface. Such a point has not
// been unloaded, it has slid off: it forgets its pressure.
template <class At, class Anchor>
void weld(const NewBonds<At>& rows, const Write<WeldPressure<At>>& pressure, const BondRules& rules,
          Row<At> row, const Anchor& anchor) {
  const int number = rows.law(row, BondLawNumber<At>::weld);
  if (number == 0) return;
  const BondRules::Law& law = rules.law(number);
  const unsigned bonded = rows.points(row);
  if (bonded != 0 && rows.law(row, BondLawNumber<At>::bonded) != number) return;
  for (int g = 0; g < edge_points; ++g) {
    const double now = pressure(row, g);
    double& largest = pressure(row, WeldPressure<At>::largest + g);
    largest = std::max(largest, now);
    if (largest <= law.threshold) continue;
    const double strength = welded_strength(law, largest);
    if ((bonded >> g & 1) != 0)
      rows.strength(row, g) = std::max(rows.strength(row, g), strength);
    else if (now < weld_at * largest) {
      if (const std::optional<BondOpening> opening = anchor(g))
        make_bond(rows, row, g, number, strength, *opening);
      else
        largest = 0;
    }
  }
}

// Rows among which pressure may weld, grouped into tasks.
template <class At, class RowWork>
void for_rows(int rows, const RowWork& work) {
  tbb::parallel_for(tbb::blocked_range<int>(0, rows, RowBlocks<At>::most), [&](const auto& range) {
    for (int r = range.begin(); r < range.end(); ++r) work(Row<At>(r));
  });
}

}  // namespace pulvis
