// fragments: which particles are held together by bonds, and the broken share of every particle's bonds.
//
// Law      a bond between particles joins them as long as one of its points holds, whatever its origin; bonds with
//          tools join nothing. The broken share counts bonds made at the start, not welds
// Runs     on sampled steps, after bond_totals
// Active   when the scene has bonds
#include <bit>

#include "systems/observe/fragments_kernel.hpp"
#include "systems/observe/new_cracks.hpp"
#include "systems/observe/systems.hpp"

namespace pulvis {
namespace {

// Adds up the intact bonds. `other_of(row)`: number of the particle on the other side, or none (-1).
template <class At>
class BondsThatHold {
 public:
  BondsThatHold(const fragments& system, const BondedRows<At>& rows)
      : system_(system), rows_(rows) {}

  template <class OtherOf>
  void add_to(kernels::DisjointSets& sets, const OtherOf& other_of) const {
    for (int r = 0; r < rows_.pair.rows(); ++r) {
      const Row<At> row(r);
      const unsigned points = rows_.points(row);
      if (points == 0) continue;
      const int number = entry(system_.bodies->slots, rows_.pair(row, 0)).number;
      const int other = other_of(row), law = rows_.law(row, BondLawNumber<At>::bonded);
      if (other >= 0) sets.join(number, other);
      entry(system_.found->points, law - 1) += std::popcount(points);
      if ((*system_.rules)->law(law).pressed()) continue;
      const double length = length_of_points(row, points);
      entry(system_.found->bonded, number) += length;
      if (other >= 0) entry(system_.found->bonded, other) += length;
    }
  }

 private:
  // m, as for cracks: half of it if the other side is sampled too.
  double length_of_points(Row<At> row, unsigned points) const {
    constexpr double share = std::is_same_v<At, Contact> ? 0.5 : 1;
    double area = 0;
    for (int g = 0; g < edge_points; ++g)
      if ((points >> g & 1) != 0) area += rows_.contact(row, ContactLaw<At>::weight + g);
    return share * area / system_.bodies->thickness;
  }

  const fragments& system_;
  const BondedRows<At>& rows_;
};

}  // namespace

void fragments::operator()() const {
  found->restart(bodies->particles(), totals->made.size());
  const auto number_of = [&](int slot) { return entry(bodies->slots, slot).number; };
  kernels::DisjointSets sets(bodies->particles());
  if (pairs)
    BondsThatHold<Contact>(*this, *pairs).add_to(sets, [&](Row<Contact> row) {
      return number_of(pairs->pair(row, 2));
    });
  if (tools)
    BondsThatHold<ToolContact>(*this, *tools).add_to(sets, [](Row<ToolContact>) { return -1; });
  found->of_particle = sets.roots();
  if (rules) count_new_cracks(*bodies, **rules, *totals, *found);
}

}  // namespace pulvis
