// contact_health: stops a run in which a surface went too deep into another (a body on its way through
// a wall looks like that first).
//
// Runs     every step, after the forces
#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "components/run_state.hpp"
#include "engine/access.hpp"
#include "engine/entry.hpp"
#include "engine/run_failure.hpp"
#include "systems/contact/contact_sums.hpp"
#include "systems/contact/systems.hpp"

namespace pulvis {

namespace {

// What a row's third key is called: "particle 7", "tool 'top'".
using PartnerName = std::function<std::string(int)>;

template <class At>
void check_rows(const Bodies& bodies, const Clock& clock, double limit, const char* system,
                const PartnerName& partner, const RowsInSum<At>& rows, double& deepest) {
  BlockSums worst;
  for (const BlockSums& block : rows.sums->blocks)
    if (block.deepest >= 0) book_depth(Row<At>(block.deepest), block.depth, worst);
  deepest = std::max(deepest, worst.depth);
  if (worst.depth <= limit) return;  // NaN is not
  const Row<At> row(worst.deepest);
  const Bodies::Slot& slot = entry(bodies.slots, rows.pair(row, 0));
  const Shape::Edge& edge = entry(bodies.shape_of_slot(rows.pair(row, 0)).edges, rows.pair(row, 1));
  throw RunFailure(fmt::format(
      "{}: particle {}, edge {} against {}: penetration {:.6g} m is {:.3g} of the edge length at "
      "step {}, t = {:.6g} s; allowed {:.3g} (limits.penetration)",
      system, slot.number, rows.pair(row, 1), partner(rows.pair(row, 2)), worst.depth * edge.length,
      worst.depth, clock.step, clock.time, limit));
}

}  // namespace

void contact_health::operator()() const {
  const double limit = rules->penetration_limit;
  totals->penetration = 0;
  if (pairs)
    check_rows<Contact>(
        *bodies, *clock, limit, "edge_contact",
        [&](int slot) { return fmt::format("particle {}", entry(bodies->slots, slot).number); },
        *pairs, totals->penetration);
  if (tools)
    check_rows<ToolContact>(
        *bodies, *clock, limit, "tool_contact",
        [&](int tool) { return fmt::format("tool '{}'", entry((*program)->names, tool)); }, *tools,
        totals->penetration);
  totals->worst_penetration = std::max(totals->worst_penetration, totals->penetration);
}

}  // namespace pulvis
