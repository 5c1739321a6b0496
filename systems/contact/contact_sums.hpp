// Sums of a narrow phase: energy stored, energy dissipated and counts for the candidates of a block.
#pragma once

#include <bit>
#include <cmath>

#include "engine/entry.hpp"
#include "systems/contact/two_candidates.hpp"

namespace pulvis {

// Records the depth of a candidate: the first NaN, or the deepest.
template <class At>
void record_depth(Row<At> row, double depth, BlockSums& sums) {
  if (depth <= sums.depth || std::isnan(sums.depth)) return;
  sums.depth = depth;
  sums.deepest = row.value;
}

// Records the projection of two candidates: `unconverged`, the lanes with no closest point found.
template <class At>
[[gnu::noinline, gnu::cold]] void record_unconverged(const TwoCandidates<At>& two,
                                                     unsigned unconverged, BlockSums& sums) {
  for (int half = 0; half < count_of(two); ++half) {
    const int points = std::popcount(half_of(unconverged, half));
    if (points > 0 && sums.unconverged == 0) sums.first_unconverged = entry(two, half).value;
    sums.unconverged += points;
  }
}
template <class At>
[[gnu::always_inline]] inline void record_projection(const TwoCandidates<At>& two,
                                                     unsigned unconverged, BlockSums& sums) {
  sums.projections += edge_points * count_of(two);
  if (unconverged != 0) record_unconverged(two, unconverged, sums);
}

// The running sums of a block: lane by lane, added up at its end.
struct LaneSums {
  using Block = BlockSums;
  Lane energy{}, friction_work{}, damping_work{}, indentation_work{};
  BlockSums block;  // the other sums

  // For those of the two candidates that touch (bit 0, bit 1).
  [[gnu::always_inline]] void add(const PointForces& f, unsigned touching) {
    const LaneMask touch = LaneMask::of(entry(lanes_of_halves, touching));
    energy += select(touch, f.energy, Lane{});
    friction_work += select(touch, f.friction_work, Lane{});
    damping_work += select(touch, f.damping_work, Lane{});
  }
  template <class At>
  [[gnu::always_inline]] void add_depth(const TwoCandidates<At>& two, unsigned bearing,
                                        const Lane& depth) {
    const LaneMask bear = LaneMask::of(entry(lanes_of_halves, bearing));
    const bool deeper = any(bear & ~(depth <= block.depth));
    for (int half = 0; half < 2; ++half) {
      if ((bearing >> half & 1) == 0) continue;
      block.touching += 1;
      if (deeper) record_depth(entry(two, half), greatest_of_half(depth, half), block);
    }
  }
  BlockSums added_up() const {
    BlockSums sums = block;
    const SumsOfHalves ab = sums_of_halves(energy, friction_work);
    const SumsOfHalves c = sums_of_halves(damping_work, indentation_work);
    sums.energy = ab.a[0] + ab.a[1];
    sums.friction_work = ab.b[0] + ab.b[1];
    sums.damping_work = c.a[0] + c.a[1];
    sums.indentation_work = c.b[0] + c.b[1];
    return sums;
  }
};

}  // namespace pulvis
