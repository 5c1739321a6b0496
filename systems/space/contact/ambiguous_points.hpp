// Points whose closest point on the other particle is in doubt: far inside it, or not converged.
#pragma once

#include <bit>

#include "systems/space/contact/projection.hpp"

namespace pulvis::space {

inline constexpr double ambiguous_depth = 0.25;  // relative to the size of a face

// Of the ambiguous points, those that ended in the fold of a crushed face, where the normal is misleading.
[[gnu::noinline]] inline unsigned in_folds(const Projection& p, const SurfaceGap& nearest,
                                           unsigned ambiguous) {
  constexpr double least_cosine = 0.3;
  unsigned folds = 0;
  for (unsigned left = ambiguous; left != 0; left &= left - 1) {
    const int l = std::countr_zero(left);
    if (!(nearest.gap[l] > 0)) continue;
    const PatchNumbers face{p.first, entry(p.shape->faces, entry(p.face, l)).number.data()};
    const VectorLanes& n = nearest.normal;
    if (along_face(face, {n.x[l], n.y[l], n.z[l]}) < least_cosine) folds |= 1U << l;
  }
  return folds;
}

// Newton's method may end on the far side of a flat particle, as if the point had passed through it. Started from the
// nearest of a few spots on every face it ends elsewhere: ambiguous points restart there if that spot is nearer.
[[gnu::noinline]] inline ProjectionStart better_start(const Projection& found,
                                                      const ProjectionStart& start,
                                                      unsigned ambiguous) {
  ProjectionStart nearest = start;
  for (unsigned left = ambiguous; left != 0; left &= left - 1) {
    const int l = std::countr_zero(left);
    const SurfaceSpot spot = nearest_spot(*found.shape, found.first,
                                          {found.point.x[l], found.point.y[l], found.point.z[l]});
    entry(nearest.face, l) = spot.face;
    nearest.u[l] = spot.u;
    nearest.v[l] = spot.v;
  }
  Projection again(*found.shape, found.first, found.point, nearest);
  again.find();
  const LaneMask nearer = dot(again.offset, again.offset) < dot(found.offset, found.offset);
  const LaneMask better = LaneMask::of(again.done & (found.unconverged() | nearer.bits()));
  ProjectionStart best{start.face, select(better, nearest.u, start.u),
                       select(better, nearest.v, start.v)};
  for (unsigned left = better.bits(); left != 0; left &= left - 1) {
    const int l = std::countr_zero(left);
    entry(best.face, l) = entry(nearest.face, l);
  }
  return best;
}

// Finds ambiguous points anew. `start`: of the search so far; `inv_size` 1/m, of the sampled faces; `real`: the points.
inline void resolve_ambiguous(Projection& p, SurfaceGap& nearest, const ProjectionStart& start,
                              const Lane& inv_size, unsigned real) {
  const LaneMask deep = nearest.gap * inv_size > ambiguous_depth;
  const unsigned ambiguous = (deep.bits() | p.unconverged()) & real;
  if (ambiguous == 0) return;
  Projection again(*p.shape, p.first, p.point, better_start(p, start, ambiguous));
  again.find();
  p = again;
  nearest = p.surface_gap();
  p.done &= ~in_folds(p, nearest, ambiguous);
}

}  // namespace pulvis::space
