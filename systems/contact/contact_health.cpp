// contact_health: stops a run in which a surface has penetrated another too deeply (first sign of a body passing
// through a wall), or in which too many closest points were not found: a missed point carries no force.
//
// Runs     every step, after the forces
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "components/run_state.hpp"
#include "engine/access.hpp"
#include "engine/entry.hpp"
#include "engine/run_failure.hpp"
#include "systems/contact/contact_sums.hpp"
#include "systems/contact/projection.hpp"
#include "systems/contact/systems.hpp"

namespace pulvis {

namespace {

// Display name for a candidate's third key: "particle 7", "tool 'top'".
using PartnerName = std::function<std::string(int)>;

// "particle 3, edge 12 against particle 7"
template <class At>
std::string name_of(const Bodies& bodies, const Read<ContactPair<At>>& pair, Row<At> row,
                    const PartnerName& partner) {
  return fmt::format("particle {}, edge {} against {}", entry(bodies.slots, pair(row, 0)).number,
                     pair(row, 1), partner(pair(row, 2)));
}

template <class At>
BlockSums deepest_of(const ContactSums<At>& sums) {
  BlockSums worst;
  for (const BlockSums& block : sums.blocks)
    if (block.deepest >= 0) book_depth(Row<At>(block.deepest), block.depth, worst);
  return worst;
}

template <class At>
void check_depth(const Bodies& bodies, const Clock& clock, double limit, const char* system,
                 const PartnerName& partner, const RowsInSum<At>& rows, const BlockSums& worst) {
  if (worst.depth <= limit) return;  // false for NaN
  const Row<At> row(worst.deepest);
  const Shape::Edge& edge = entry(bodies.shape_of_slot(rows.pair(row, 0)).edges, rows.pair(row, 1));
  throw RunFailure(
      fmt::format("{}: {}: penetration {:.6g} m is {:.3g} of the edge length at step {}, t = "
                  "{:.6g} s; allowed {:.3g} (limits.penetration)",
                  system, name_of(bodies, rows.pair, row, partner), worst.depth * edge.length,
                  worst.depth, clock.step, clock.time, limit));
}

// The run's share grows only in steps in which some are not found: one of them is reported.
void check_projections(const Bodies& bodies, const Clock& clock, double limit,
                       const PartnerName& partner, const RowsInSum<Contact>& rows,
                       const Totals& totals) {
  if (totals.unconverged_share() <= limit) return;
  const auto found = std::ranges::find_if(
      rows.sums->blocks, [](const BlockSums& block) { return block.unconverged > 0; });
  if (found == rows.sums->blocks.end()) return;
  throw RunFailure(fmt::format(
      "edge_contact: {}: the closest point was not found in {} steps of Newton's method, at step "
      "{}, t = {:.6g} s, as for {} of {} points so far, a share of {:.3g}; allowed {:.3g} "
      "(limits.unconverged_projections; a finer mesh may help)",
      name_of(bodies, rows.pair, Row<Contact>(found->first_unconverged), partner),
      Projection::max_steps, clock.step, clock.time, totals.unconverged, totals.projections,
      totals.unconverged_share(), limit));
}

}  // namespace

void contact_health::operator()() const {
  const PartnerName particle = [&](int slot) {
    return fmt::format("particle {}", entry(bodies->slots, slot).number);
  };
  const PartnerName tool = [&](int number) {
    return fmt::format("tool '{}'", entry((*program)->names, number));
  };
  const BlockSums of_pairs = pairs ? deepest_of(*pairs->sums) : BlockSums{};
  const BlockSums of_tools = tools ? deepest_of(*tools->sums) : BlockSums{};
  totals->penetration =
      maximum_of_ranks(link, std::max(std::max(0.0, of_pairs.depth), of_tools.depth));
  // A point that was not found may look deep: that is reported first. With NaNs nothing is found.
  if (pairs && !std::isnan(of_pairs.depth))
    check_projections(*bodies, *clock, rules->unconverged_limit, particle, *pairs, *totals);
  const double limit = rules->penetration_limit;
  if (pairs) check_depth(*bodies, *clock, limit, "edge_contact", particle, *pairs, of_pairs);
  if (tools) check_depth(*bodies, *clock, limit, "tool_contact", tool, *tools, of_tools);
  totals->worst_penetration = std::max(totals->worst_penetration, totals->penetration);
}

}  // namespace pulvis
