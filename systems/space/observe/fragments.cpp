// fragments: which particles are held together by bonds, and the broken share of every particle's bonds, in three
// dimensions.
//
// Law      as in two dimensions (systems/observe/fragments.cpp)
// Runs     on sampled steps, after bond_totals
// Active   when the scene has bonds
#include <bit>

#include "systems/observe/fragments_kernel.hpp"
#include "systems/observe/new_cracks.hpp"
#include "systems/space/observe/systems.hpp"

namespace pulvis::space {
namespace {

struct Laws {
  int initial, pressed;  // numbers in BondRules
};

// Counts the bonded points of a row. Returns the area of those bonded from the start. (m^2)
template <class At>
double count_points(const BondedRows<At>& rows, Row<At> row, const Shape::Face& face,
                    const Laws& laws, Fragments& found) {
  const auto all = static_cast<unsigned>(rows.points(row, BondedPoints<At>::all));
  const auto welds = static_cast<unsigned>(rows.points(row, BondedPoints<At>::welds));
  const unsigned from_start = all & ~welds;
  if (welds != 0) entry(found.points, laws.pressed - 1) += std::popcount(welds);
  if (from_start != 0) entry(found.points, laws.initial - 1) += std::popcount(from_start);
  double area = 0;
  for (unsigned left = from_start; left != 0; left &= left - 1)
    area += entry(face.weight, std::countr_zero(left));
  return area;
}

const Shape::Face& face_of(const ShapedBodies<ThreeD>& bodies, int slot, int face) {
  return entry(bodies.shape_of(slot).faces, face);
}

}  // namespace

void fragments::operator()() const {
  const Bodies& all = *bodies.bodies;
  kernels::DisjointSets sets(all.particles());
  found->restart(all.particles(), totals->made.size());
  for (int r = 0; pairs && r < pairs->pair.rows(); ++r) {
    const Row<FaceContact> row(r);
    if (pairs->points(row, 0) == 0) continue;
    const auto &a = entry(all.slots, pairs->pair(row, 0)),
               &b = entry(all.slots, pairs->pair(row, 2));
    sets.join(a.number, b.number);
    const Laws laws{(*rules)->initial_between(a, b), (*rules)->pressed_between(a, b)};
    // The other side is sampled too.
    const double area =
        0.5 * count_points(*pairs, row, face_of(bodies, pairs->pair(row, 0), pairs->pair(row, 1)),
                           laws, *found);
    entry(found->bonded, a.number) += area;
    entry(found->bonded, b.number) += area;
  }
  for (int r = 0; tools && r < tools->pair.rows(); ++r) {
    const Row<FaceToolContact> row(r);
    if (tools->points(row, 0) == 0) continue;
    const auto& body = entry(all.slots, tools->pair(row, 0));
    const int tool = tools->pair(row, 2);
    const Laws laws{(*rules)->initial_with_tool(tool, body),
                    (*rules)->pressed_with_tool(tool, body)};
    entry(found->bonded, body.number) += count_points(
        *tools, row, face_of(bodies, tools->pair(row, 0), tools->pair(row, 1)), laws, *found);
  }
  found->of_particle = sets.roots();
  if (rules) count_new_cracks(all, **rules, *totals, *found);
}

}  // namespace pulvis::space
