// element_health: stops a run whose elements turned inside out or went NaN.
// contact_health: stops a run in which a surface went too deep into another (a body on its way through
// a wall looks like that first).
//
// Runs     every step, after the forces
#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "components/run_state.hpp"
#include "engine/access.hpp"
#include "systems/contact_row.hpp"
#include "systems/row_sum.hpp"
#include "systems/run_failure.hpp"
#include "systems/systems.hpp"

namespace pulvis {

void element_health(Read<Bodies> bodies, Read<Clock> clock, Read<LeastJacobian> least,
                    Read<WorstElement> worst, Write<Totals> totals) {
  const auto values = least.values();
  for (std::size_t slot = 0; slot < values.size(); ++slot) {
    totals->least_jacobian = std::min(totals->least_jacobian, values[slot]);
    if (values[slot] > 0) continue;  // NaN is not
    throw RunFailure(fmt::format(
        "trial_stress: particle {}, element {}: det F = {:.6g} at step {}, t = {:.6g} s: the "
        "element "
        "turned inside out; allowed > 0 (is a tool too fast, or the mesh too coarse for the load?)",
        bodies->slots[slot].number, static_cast<int>(worst.values()[slot]), values[slot],
        clock->step, clock->time));
  }
}

namespace {

// What a row's third key is called: "particle 7", "tool 'top'".
using PartnerName = std::function<std::string(int)>;

struct Depths {
  double deepest = 0;     // -, of the edge length
  std::int32_t bad = -1;  // first row beyond the limit, or NaN
  void operator+=(const Depths& later) {
    deepest = std::max(deepest, later.deepest);
    if (bad < 0) bad = later.bad;
  }
};

template <class At>
void check_rows(const Bodies& bodies, const Clock& clock, double limit, const char* system,
                const PartnerName& partner, const Read<ContactPair<At>>& pair,
                const Read<Penetration<At>>& penetration, const Read<EdgeLength<At>>& length,
                double& deepest) {
  const auto depth = [&](int r) { return penetration(Row<At>(r)) / length(Row<At>(r)); };
  const auto depths = sum_over_rows<Depths>(pair.rows(), [&](int r, Depths& part) {
    const double deep = depth(r);
    part.deepest = std::max(part.deepest, deep);
    if (!(deep <= limit) && part.bad < 0) part.bad = r;
  });
  deepest = std::max(deepest, depths.deepest);
  if (depths.bad < 0) return;
  const Row<At> row(depths.bad);
  throw RunFailure(fmt::format(
      "{}: particle {}, edge {} against {}: penetration {:.6g} m is {:.3g} of the edge length at "
      "step {}, t = {:.6g} s; allowed {:.3g} (limits.penetration)",
      system, bodies.slots[static_cast<std::size_t>(pair(row, 0))].number, pair(row, 1),
      partner(pair(row, 2)), penetration(row), depth(depths.bad), clock.step, clock.time, limit));
}

}  // namespace

void contact_health(Read<Bodies> bodies, Read<Clock> clock, Read<ContactRules> rules,
                    Optional<Read<ContactPair<Contact>>> pair,
                    Optional<Read<Penetration<Contact>>> penetration,
                    Optional<Read<EdgeLength<Contact>>> length,
                    Optional<Read<ContactPair<ToolContact>>> tool_pair,
                    Optional<Read<Penetration<ToolContact>>> tool_penetration,
                    Optional<Read<EdgeLength<ToolContact>>> tool_length,
                    Optional<Read<ToolProgram>> program, Write<Totals> totals) {
  const double limit = rules->penetration_limit;
  totals->penetration = 0;
  if (pair)
    check_rows<Contact>(
        *bodies, *clock, limit, "edge_contact",
        [&](int slot) {
          return fmt::format("particle {}", bodies->slots[static_cast<std::size_t>(slot)].number);
        },
        *pair, *penetration, *length, totals->penetration);
  if (tool_pair)
    check_rows<ToolContact>(
        *bodies, *clock, limit, "tool_contact",
        [&](int tool) {
          return fmt::format("tool '{}'", (*program)->names[static_cast<std::size_t>(tool)]);
        },
        *tool_pair, *tool_penetration, *tool_length, totals->penetration);
  totals->worst_penetration = std::max(totals->worst_penetration, totals->penetration);
}

}  // namespace pulvis
