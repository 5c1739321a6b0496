// Which edges of which particles are near which others: pure geometry, no columns. Exact with respect
// to the boxes of control points, which contain their curve (convex hull property of B-splines).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "components/shape.hpp"
#include "systems/contact/by_slot.hpp"

namespace pulvis {

struct Box {
  double low[2], high[2];
};

// Edges of one outline that are nearer than this along it never touch each other.
inline constexpr int least_fold = 4;
// Along a closed outline of `edges`.
int edges_between(int a, int b, int edges);

// One candidate: an edge of the particle in `slot` within `skin` of the particle in `other`, whose edge
// `start` is the nearest to it. `other` = `slot`: the outline comes near itself.
struct EdgeCandidate {
  std::int32_t slot, edge, other, start;
};

Box box_of(const double* points, int count);
bool near(const Box& a, const Box& b, double skin);

// Of every slot the slots of the particles within `distance` (of boxes), itself included, ascending. `control`:
// x y of every control point.
BySlot<std::int32_t> particle_neighbours(const Bodies& bodies, std::span<const double> control,
                                         double distance);

// All candidates, sorted by (slot, edge, other). `neighbours`: within `skin` or more.
BySlot<EdgeCandidate> edge_candidates(const Bodies& bodies, std::span<const double> control,
                                      const BySlot<std::int32_t>& neighbours, double skin);

}  // namespace pulvis
