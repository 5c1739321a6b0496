// tool_reaction: the forces of the particles on each tool in three dimensions, and the work done by the tools.
//
// Runs     after the narrow phase
#include <algorithm>
#include <cmath>

#include "systems/space/tools/systems.hpp"

namespace pulvis::space {

// Work by the trapezoidal rule: mean of the forces at both ends of the step, which keeps the leapfrog's energy balance
// second-order accurate.
void tool_reaction::operator()() const {
  const auto power = [&] {
    double sum = 0;
    for (int t = 0; t < tool_force.rows(); ++t)
      for (int k = 0; k < 3; ++k) sum -= tool_force(Row<Tool>(t), k) * velocity(Row<Tool>(t), k);
    return sum;
  };
  const double power_before = power();
  std::vector<ExactSum> forces(tool_force.values().size());
  for (int r = 0; r < contacts.pair.rows(); ++r) {
    const Row<FaceToolContact> row(r);
    if (contacts.touches(row) == 0) continue;
    for (int k = 0; k < 3; ++k) {
      double sum = 0;
      for (int g = 0; g < face_points; ++g) sum -= contacts.force(row, face_points * k + g);
      entry(forces, tool_axes * contacts.pair(row, 2) + k).add(sum);
    }
  }
  sum_of_ranks(link, forces);
  std::ranges::transform(forces, tool_force.values().begin(), &ExactSum::value);
  const double work = 0.5 * (power_before + power()) * clock->dt_before;
  totals->external_work += work;
  totals->largest_work = std::max(totals->largest_work, std::abs(work));
}

}  // namespace pulvis::space
