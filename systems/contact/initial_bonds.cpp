// initial_bonds: bonds surfaces that touch at the start.
// initial_bond_totals: totals of these over all ranks, including bonds with tools.
//
// Law      a point within `reach` of its closest point on a surface that faces it; an initial gap belongs to the bond
//          and carries no force
// Runs     once, at the start, after the first search for contacts
// Active   when the scene has bonds between particles; the totals if the run has several ranks
#include <algorithm>
#include <cmath>
#include <limits>

#include "systems/contact/contact_outlines.hpp"
#include "systems/contact/new_bonds.hpp"

namespace pulvis {
namespace {

// A point beside the surface, past a corner, is not a neighbour.
constexpr double beside = 1e-3;  // of the edge length
constexpr double facing = -0.5;  // product of the normals

}  // namespace

void initial_bonds::operator()() const {
  const Outlines outlines(*bodies, control.values());
  for (int r = 0; r < rows.pair.rows(); ++r) {
    const Row<Contact> row(r);
    const int slot = rows.pair(row, 0), edge = rows.pair(row, 1), other = rows.pair(row, 2);
    if (!bodies->owns(slot)) continue;
    if (slot == other && (!at.images || at.images->of(row) == ImageIn<TwoD>{})) continue;
    const Point shift = at.images ? at.images->shift(row) : Point{};
    const auto& a = entry(bodies->slots, slot);
    const auto& b = entry(bodies->slots, other);
    const int number = rules->initial_between(a, b);
    if (number == 0) continue;
    const BondRules::Law& law = rules->law(number);
    const double length = entry(bodies->shape_of_slot(slot).edges, edge).length;
    const double strength = drawn_strength(law, a.number, b.number);
    const Curve sampled = outlines.edge(slot, edge);
    for (int g = 0; g < edge_points; ++g) {
      const double u = entry(kernels::edge_u, g);
      const PackedCurvePoint at_other = at.closest(row, g);
      const CurvePoint there = at_other.unpacked();
      const Curve curve = outlines.from(other, there.edge);
      const Point n = curve.normal(there.u), on = curve.value(there.u), from = sampled.value(u);
      const Point own = sampled.normal(u),
                  d{from[0] - shift[0] - on[0], from[1] - shift[1] - on[1]};
      const BondOpening opening{d[0] * n[0] + d[1] * n[1], d[1] * n[0] - d[0] * n[1]};
      if (std::abs(opening.along) > beside * length || n[0] * own[0] + n[1] * own[1] > facing)
        continue;
      entry(totals->nearest, number - 1).take(std::abs(opening.normal), length);
      if (std::abs(opening.normal) > law.reach * length) continue;
      at.anchor(row, g) = at_other;
      make_bond(rows, row, g, number, strength, opening);
      entry(totals->made, number - 1) += 1;
    }
  }
}

void initial_bond_totals::operator()() const {
  std::vector<std::int64_t> made(totals->made.begin(), totals->made.end());
  link->ranks->sum(made);
  std::vector<double> share, width;  // negative, so that the largest are the nearest
  for (const BondTotals::Gap& gap : totals->nearest) share.push_back(-gap.share);
  link->ranks->maximum(share);
  for (std::size_t law = 0; law < share.size(); ++law) {
    const BondTotals::Gap& own = totals->nearest[law];
    width.push_back(-own.share == share[law] ? -own.width
                                             : -std::numeric_limits<double>::infinity());
  }
  link->ranks->maximum(width);
  for (std::size_t law = 0; law < made.size(); ++law) {
    totals->made[law] = static_cast<std::int32_t>(made[law]);
    totals->nearest[law] = {-width[law], -share[law]};
  }
}

}  // namespace pulvis
