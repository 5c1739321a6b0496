// contact_health: stops a run in which a surface has penetrated another too deeply (first sign of a body passing
// through a wall), or in which too many closest points were not found: a missed point carries no force.
//
// Runs     every step, after the forces
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "components/run_state.hpp"
#include "components/space/contact.hpp"
#include "engine/access.hpp"
#include "engine/entry.hpp"
#include "engine/run_failure.hpp"
#include "systems/contact/systems.hpp"

namespace pulvis {
namespace {

// How messages name the sampled side.
struct Words {
  const char *narrow_phase, *side, *size;
};
constexpr Words words_of(TwoD) { return {"edge_contact", "edge", "edge length"}; }
constexpr Words words_of(ThreeD) { return {"face_contact", "face", "size of the face"}; }

double size_of_side(const Shape& shape, int edge) { return entry(shape.edges, edge).length; }
double size_of_side(const space::Shape& shape, int face) { return entry(shape.faces, face).size; }

struct Deepest {
  double depth = 0;  // relative to the size of its edge or face; NaN if any is
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

template <class D>
class Watch {
 public:
  explicit Watch(const contact_health<D>& system) : s_(system) {}

  template <class At>
  void depth(const char* system, const RowsInSum<At>& rows, const Deepest& worst) const {
    const double limit = s_.rules->penetration_limit;
    if (worst.depth <= limit) return;  // false for NaN
    const Row<At> row(worst.row);
    const double size = size_of_side(s_.bodies.shape_of(rows.pair(row, 0)), rows.pair(row, 1));
    throw RunFailure(fmt::format(
        "{}: {}: penetration {:.6g} m is {:.3g} of the {} at step {}, t = {:.6g} s; allowed {:.3g} "
        "(limits.penetration)",
        system, name_of(rows.pair, row), worst.depth * size, worst.depth, words.size,
        s_.clock->step, s_.clock->time, limit));
  }

  // The run's share grows only in steps in which some are not found: one of them is reported.
  void projections(const RowsInSum<typename D::Contact>& rows) const {
    const Totals& totals = *s_.totals;
    if (totals.unconverged_share() <= s_.rules->unconverged_limit) return;
    const auto found = std::ranges::find_if(
        rows.sums->blocks, [](const BlockSums& block) { return block.unconverged > 0; });
    if (found == rows.sums->blocks.end()) return;
    throw RunFailure(fmt::format(
        "{}: {}: the closest point was not found by Newton's method, at step {}, t = {:.6g} s, as "
        "for {} of {} points so far, a share of {:.3g}; allowed {:.3g} "
        "(limits.unconverged_projections; a finer mesh may help)",
        words.narrow_phase, name_of(rows.pair, Row<typename D::Contact>(found->first_unconverged)),
        s_.clock->step, s_.clock->time, totals.unconverged, totals.projections,
        totals.unconverged_share(), s_.rules->unconverged_limit));
  }

  static constexpr Words words = words_of(D{});

 private:
  // "particle 3, edge 12 against particle 7"
  template <class At>
  std::string name_of(const Read<ContactPair<At>>& pair, Row<At> row) const {
    return fmt::format("particle {}, {} {} against {}", number(pair(row, 0)), words.side,
                       pair(row, 1), other(row, pair(row, 2)));
  }
  std::string other(Row<typename D::Contact>, int slot) const {
    return fmt::format("particle {}", number(slot));
  }
  std::string other(Row<typename D::ToolContact>, int tool) const {
    return fmt::format("tool '{}'", entry((*s_.program)->names, tool));
  }
  int number(int slot) const { return entry(s_.bodies.bodies->slots, slot).number; }

  const contact_health<D>& s_;
};

}  // namespace

template <class D>
void contact_health<D>::operator()() const {
  const Watch<D> watch(*this);
  const Deepest of_pairs = pairs ? deepest_of(pairs->sums->blocks) : Deepest{};
  const Deepest of_tools = tools ? deepest_of(tools->sums->blocks) : Deepest{};
  totals->penetration =
      maximum_of_ranks(link, std::max(std::max(0.0, of_pairs.depth), of_tools.depth));
  // A point that was not found may look deep: that is reported first. With NaNs nothing is found.
  if (pairs && !std::isnan(of_pairs.depth)) watch.projections(*pairs);
  if (pairs) watch.depth(watch.words.narrow_phase, *pairs, of_pairs);
  if (tools) watch.depth("tool_contact", *tools, of_tools);
  totals->worst_penetration = std::max(totals->worst_penetration, totals->penetration);
}
template struct contact_health<TwoD>;
template struct contact_health<ThreeD>;

}  // namespace pulvis
