// Which edges of which particles are near which others: pure geometry, no columns. Exact with respect
// to the boxes of control points, which contain their curve (convex hull property of B-splines).
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "components/shape.hpp"
#include "systems/contact/neighbours.hpp"

namespace pulvis {

// Edges of one outline closer than this along it can touch only if the outline turns by two thirds of a half
// turn between them, at the root of a notch: the product of their normals is then below that.
inline constexpr int min_fold = 4;
inline constexpr double sharp_fold = -0.5;
// Activation of a self-contact candidate that sees its own neighbourhood or the back face of a thin part.
inline constexpr double back_face = std::numeric_limits<double>::infinity();
// Along a closed outline with `edges` edges.
int edges_between(int a, int b, int edges);

// One candidate: an edge of the particle in `slot` within `skin` of the particle in `other`, whose nearest
// edge is `start`. `other` = `slot`: self-contact; `start` is then the nearest edge that it faces from
// outside (`faces`), or the nearest of all if it faces none: the back face of a thin part is often nearer
// than the flank across a gap.
struct EdgeCandidate {
  std::int32_t slot, edge, other, start;
  bool faces;
  ImageIn<TwoD> image{};  // of the other particle

  bool itself() const { return slot == other && image == ImageIn<TwoD>{}; }
};

using Neighbour = NeighbourIn<TwoD>;
using Image = ImageIn<TwoD>;

// For every slot, the particles within `distance` (of boxes), itself included, ascending by slot and image.
// `control`: x y of every control point; `cell`: null if nothing is periodic.
BySlot<Neighbour> particle_neighbours(const Bodies& bodies, std::span<const double> control,
                                      const PeriodicCell<TwoD>* cell, double distance);

// All candidates, sorted by (slot, edge, other, image). `neighbours`: within `skin` or more.
BySlot<EdgeCandidate> edge_candidates(const Bodies& bodies, std::span<const double> control,
                                      const PeriodicCell<TwoD>* cell,
                                      const BySlot<Neighbour>& neighbours, double skin);

// The edge from which point `point` of a new candidate starts its closest-point search: `start`, or an edge that meets it
// at a corner if that is nearer to the point. The search passes a corner only for points beside it, and the edge nearest to
// the middle of the sampled one may be the wrong one for some of its points.
int start_of_point(const Bodies& bodies, std::span<const double> control,
                   const PeriodicCell<TwoD>* cell, const EdgeCandidate& candidate, int point);

}  // namespace pulvis
