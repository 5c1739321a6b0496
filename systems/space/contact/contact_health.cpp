// contact_health: stops a run in three dimensions if a surface penetrates too deeply into another, or if too many
// closest-point projections do not converge: such contacts carry no force.
//
// Runs     every step, after the forces
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/run_failure.hpp"
#include "systems/space/contact/systems.hpp"

namespace pulvis::space {
namespace {

struct Deepest {
  double depth = 0;  // relative to the size of its face; NaN if any is NaN
  std::int32_t row = -1;
};
Deepest deepest_of(const std::vector<BlockSums>& blocks) {
  Deepest worst;
  for (const BlockSums& block : blocks) {
    if (block.deepest < 0 || block.depth <= worst.depth || std::isnan(worst.depth)) continue;
    worst = {block.depth, block.deepest};
  }
  return worst;
}

// "particle 3, face 12 against "
template <class At>
std::string sampled_face(const ShapedBodies& bodies, const Read<ContactPair<At>>& pair,
                         std::int32_t number) {
  const Row<At> row(number);
  return fmt::format("particle {}, face {} against ",
                     entry(bodies.bodies->slots, pair(row, 0)).number, pair(row, 1));
}

struct Watch {
  const ShapedBodies& bodies;
  const Clock& clock;
  const ContactRules& rules;

  template <class At>
  void depth(const char* system, const Read<ContactPair<At>>& pair, const Deepest& worst,
             const std::string& partner) const {
    const Row<At> row(worst.row);
    const double size = entry(bodies.shape_of(pair(row, 0)).faces, pair(row, 1)).size;
    throw RunFailure(fmt::format(
        "{}: {}{}: penetration {:.6g} m is {:.3g} of the size of the face at step {}, t = {:.6g} "
        "s; allowed {:.3g} (limits.penetration)",
        system, sampled_face(bodies, pair, worst.row), partner, worst.depth * size, worst.depth,
        clock.step, clock.time, rules.penetration_limit));
  }
  bool too_deep(const Deepest& worst) const { return !(worst.depth <= rules.penetration_limit); }

  // The share of the run grows only in steps in which some do not converge: one of them is reported.
  void projections(const contact_health::Pairs& pairs, const Totals& totals) const {
    if (totals.unconverged_share() <= rules.unconverged_limit) return;
    const auto found = std::ranges::find_if(
        pairs.sums->blocks, [](const BlockSums& block) { return block.unconverged > 0; });
    if (found == pairs.sums->blocks.end()) return;
    const Row<FaceContact> row(found->first_unconverged);
    throw RunFailure(
        fmt::format("face_contact: {}particle {}: Newton's method did not find the closest point, "
                    "at step {}, t = {:.6g} s, as for {} of {} points so far, a share of {:.3g}; "
                    "allowed {:.3g} (limits.unconverged_projections; a finer mesh may help)",
                    sampled_face(bodies, pairs.pair, row.value),
                    entry(bodies.bodies->slots, pairs.pair(row, 2)).number, clock.step, clock.time,
                    totals.unconverged, totals.projections, totals.unconverged_share(),
                    rules.unconverged_limit));
  }
};

}  // namespace

void contact_health::operator()() const {
  const Watch watch{bodies, *clock, *rules};
  const Deepest of_pairs = pairs ? deepest_of(pairs->sums->blocks) : Deepest{};
  const Deepest of_tools = tools ? deepest_of(tools->sums->blocks) : Deepest{};
  totals->penetration = maximum_of_ranks(link, std::max(of_pairs.depth, of_tools.depth));
  // A point that did not converge may look deep: report that first. If all values are NaN, nothing converges.
  if (pairs && !std::isnan(of_pairs.depth)) watch.projections(*pairs, *totals);
  if (pairs && watch.too_deep(of_pairs))
    watch.depth(
        "face_contact", pairs->pair, of_pairs,
        fmt::format(
            "particle {}",
            entry(bodies.bodies->slots, pairs->pair(Row<FaceContact>(of_pairs.row), 2)).number));
  if (tools && watch.too_deep(of_tools))
    watch.depth(
        "tool_contact", tools->pair, of_tools,
        fmt::format("tool '{}'", entry(tools->program->names,
                                       tools->pair(Row<FaceToolContact>(of_tools.row), 2))));
  totals->worst_penetration = std::max(totals->worst_penetration, totals->penetration);
}

}  // namespace pulvis::space
