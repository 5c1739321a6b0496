// tool_reaction: the forces of the particles on each tool, and the work done by the tools.
//
// Runs     after the narrow phases and the constraints
#include <algorithm>
#include <cmath>

#include "components/run_state.hpp"
#include "engine/entry.hpp"
#include "systems/tools/systems.hpp"

namespace pulvis {
namespace {

using Forces = std::vector<ExactSum>;  // [tools * tool_axes]

template <class At>
void add_contacts(const TouchingRows<At>& rows, Forces& forces) {
  for (int r = 0; r < rows.pair.rows(); ++r) {
    const Row<At> row(r);
    if (rows.touches(row) == 0) continue;
    for (int k = 0; k < At::axes; ++k) {
      double sum = 0;
      for (int g = 0; g < At::points; ++g) sum -= rows.force(row, PointForce<At>::number(g, k));
      entry(forces, tool_axes * rows.pair(row, 2) + k).add(sum);
    }
  }
}

// A radial constraint moves in x only and stores the sum of the radial forces as x: work is force times
// displacement for every constraint.
template <class D>
void add_constraints(const Bodies& bodies, const ConstraintReactions<D>& constraints,
                     Forces& forces) {
  const std::vector<std::int32_t>& begin = constraints.index->begin;
  for (const int chunk : bodies.own_chunks)
    for (int r = entry(begin, chunk); r < entry(begin, chunk + 1); ++r) {
      const Row<ConstrainedNode> row(r);
      for (int k = 0; k < D::axes; ++k)
        entry(forces, tool_axes * constraints.target(row, 2) + k)
            .add(-constraints.travel(row, k) * constraints.reaction(row));
    }
}

}  // namespace

// Work by the trapezoidal rule: forces at both ends of the step, which keeps the energy balance of the
// leapfrog second-order accurate.
template <class D>
void tool_reaction<D>::operator()() const {
  const auto power = [&] {
    double sum = 0;
    for (int t = 0; t < tool_force.rows(); ++t)
      for (int k = 0; k < tool_axes; ++k)
        sum -= tool_force(Row<Tool>(t), k) * velocity(Row<Tool>(t), k);
    return sum;
  };
  const double power_before = power();
  Forces forces(tool_force.values().size());
  if (contacts) add_contacts(*contacts, forces);
  if (constraints) add_constraints(*bodies, *constraints, forces);
  sum_of_ranks(link, forces);
  std::ranges::transform(forces, tool_force.values().begin(), &ExactSum::value);
  const double work = 0.5 * (power_before + power()) * clock->dt_before;
  totals->external_work += work;
  totals->largest_work = std::max(totals->largest_work, std::abs(work));
}
template struct tool_reaction<TwoD>;
template struct tool_reaction<ThreeD>;

}  // namespace pulvis
