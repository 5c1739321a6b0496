// Own outline: self-contact of an outline. Two parts of it meet from outside, where it folds; seen from inside, each
// point is also at some depth below the back face of its own body.
//
// Law      winding number half way to the closest point: one behind a thin part, two where the outline overlaps
//          itself
#pragma once

#include <cmath>

#include "systems/contact/broad_phase.hpp"
#include "systems/contact/contact_outlines.hpp"
#include "systems/contact/projection.hpp"
#include "systems/contact/winding_kernel.hpp"

namespace pulvis {

// Share of an edge: no contact starts deeper; its spring would at once be stiffer than the time step assumes.
// (outline_health reports undetected ones. An existing contact may get as deep as limits.penetration allows.)
inline constexpr double deepest_begin = 0.1;

class OwnOutline {
 public:
  OwnOutline(const Shape& shape, const double* control) : shape_(shape), control_(control) {}

  // From `half_way` to the closest point on the edge `there`, along `back`, against its normal; the point is on
  // `edge`. Both edges are crossed as curves, which is known in advance; chords represent all the others.
  bool overlaps(int edge, int there, const Point& half_way, const Point& back) const {
    int times = 1;  // through the point itself, out of its own part
    for (int e = 0; e < edges(); ++e)
      if (e != edge && e != there)
        times += kernels::crossing(half_way, back, knot(e, 0), knot(e, 1));
    return times > 1;
  }
  Point normal(int edge, double u) const { return curve(edge).normal(u); }
  int edges() const { return static_cast<int>(shape_.edges.size()); }
  const Shape& shape() const { return shape_; }

 private:
  Curve curve(int edge) const {
    return Curve(control_ + 2 * entry(shape_.edges, edge).first_control);
  }
  Point knot(int edge, int end) const {
    const double* y = control_ + 2 * (entry(shape_.edges, edge).first_control + end);
    return {(y[0] + 4 * y[2] + y[4]) / 6, (y[1] + 4 * y[3] + y[5]) / 6};
  }

  const Shape& shape_;
  const double* control_;
};

// What a point of an edge sees of its own outline.
enum class OwnSight { neighbourhood, outside, fold, inside };

// For Gauss point g of `edge`, in that lane of the projection. `touched`: it touched in the step before.
inline OwnSight own_sight(const Projection& p, const PointMotion& m, int lane, int edge, int g,
                          const OwnOutline& own, bool touched) {
  const int there = edge_number(own.shape(), entry(p.at.edge, lane));
  const Point n = own.normal(edge, entry(kernels::edge_u, g)), back{-m.nx[lane], -m.ny[lane]};
  const double product = -(n[0] * back[0] + n[1] * back[1]);
  const bool near = edges_between(there, edge, own.edges()) < min_fold;
  if (there == edge || (near && product > sharp_fold)) return OwnSight::neighbourhood;
  if (!(m.gap[lane] > 0)) return OwnSight::outside;
  const bool deep = m.gap[lane] > deepest_begin * entry(own.shape().edges, edge).length;
  if (touched && !deep) return OwnSight::fold;
  const Point half_way{p.points.x[lane] - 0.5 * p.rx[lane], p.points.y[lane] - 0.5 * p.ry[lane]};
  const bool unseen = product > 0 || (deep && !touched);
  return !unseen && own.overlaps(edge, there, half_way, back) ? OwnSight::fold : OwnSight::inside;
}

// For a self-contact candidate: excludes the points that do not touch a fold (`touched`: bits of those that touched
// in the step before), and returns the distance of the nearest one outside, m: infinite if there is none.
inline double exclude_own_body(const Projection& p, int half, int edge, const OwnOutline& own,
                               unsigned touched, PointMotion& m) {
  double nearest = back_face;
  for (int g = 0; g < edge_points; ++g) {
    const int lane = half * edge_points + g;
    const OwnSight sight = own_sight(p, m, lane, edge, g, own, (touched >> g & 1) != 0);
    if (sight == OwnSight::outside)
      nearest = std::min(nearest, std::sqrt(p.rx[lane] * p.rx[lane] + p.ry[lane] * p.ry[lane]));
    else if (sight != OwnSight::fold)
      m.gap[lane] = -1;
  }
  return nearest;
}

}  // namespace pulvis
