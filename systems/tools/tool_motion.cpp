// tool_motion: programmed tool positions at t_n, and their mean velocity over the last step.
// tool_reaction: forces of the particles on each tool, and the work done by the tools.
#include <algorithm>
#include <cmath>

#include "components/contact.hpp"
#include "components/run_state.hpp"
#include "components/servo.hpp"
#include "engine/access.hpp"
#include "engine/entry.hpp"
#include "systems/tools/systems.hpp"
#include "systems/tools/tool_kernel.hpp"

namespace pulvis {

Point3 tool_position_at(const ToolProgram& program, int tool, double time) {
  Point3 at = entry(program.start, tool);
  for (const ToolProgram::Segment& s : program.segments) {
    if (s.tool != tool) continue;
    const double share =
        kernels::cut_travel((time - s.begin) / s.duration, s.ramp, (s.cut - s.begin) / s.duration);
    for (std::size_t k = 0; k < tool_axes; ++k) at[k] += share * s.displacement[k];
  }
  return at;
}

void tool_motion::operator()() const {
  for (int t = 0; t < position.rows(); ++t) {
    const Row<Tool> tool(t);
    const Point3 now = tool_position_at(*program, t, clock->time);
    const Point3 before = tool_position_at(*program, t, clock->time - clock->dt_before);
    for (int k = 0; k < tool_axes; ++k) {
      const double moved = entry(now, k) - entry(before, k);
      velocity(tool, k) = clock->dt_before > 0 ? moved / clock->dt_before : 0;
      position(tool, k) = entry(now, k);
      if (!servo) continue;
      (*servo_travel)(tool, k) += (*servo)(tool, k) * clock->dt_before;
      velocity(tool, k) += (*servo)(tool, k);
      position(tool, k) += (*servo_travel)(tool, k);
    }
  }
}

namespace {

using Forces = std::vector<ExactSum>;  // [tools * tool_axes]

void add_contacts(const TouchingRows<ToolContact>& rows, Forces& forces) {
  for (int r = 0; r < rows.pair.rows(); ++r) {
    const Row<ToolContact> row(r);
    if (rows.touches(row) == 0) continue;
    for (int k = 0; k < 2; ++k) {
      double sum = 0;
      for (int g = 0; g < edge_points; ++g) sum -= rows.force(row, 2 * g + k);
      entry(forces, tool_axes * rows.pair(row, 2) + k).add(sum);
    }
  }
}

// A radial constraint moves in x only and stores the sum of the radial forces as x: work is force times
// displacement for every constraint.
void add_constraints(const Bodies& bodies, const tool_reaction::Constraints& constraints,
                     Forces& forces) {
  const std::vector<std::int32_t>& begin = constraints.index->begin;
  for (const int chunk : bodies.own_chunks)
    for (int r = entry(begin, chunk); r < entry(begin, chunk + 1); ++r) {
      const Row<ConstrainedNode> row(r);
      for (int k = 0; k < 2; ++k)
        entry(forces, tool_axes * constraints.target(row, 2) + k)
            .add(-constraints.travel(row, k) * constraints.reaction(row));
    }
}

}  // namespace

// Work by the trapezoidal rule: forces at both ends of the step, which keeps the energy balance of the
// leapfrog second-order accurate.
void tool_reaction::operator()() const {
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

}  // namespace pulvis
