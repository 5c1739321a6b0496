// Motion of points relative to the surface of another particle, and what their forces do to its slopes.
//
// Law      contact_law.hpp (slip), other_loads.hpp (loads on the slopes)
#pragma once

#include "systems/space/contact/contact_law.hpp"
#include "systems/space/contact/other_loads.hpp"
#include "systems/space/contact/patch_kernel.hpp"

namespace pulvis::space {

// Reciprocal slopes of the other surface.
struct Reciprocal {
  VectorLanes u, v;
  static Reciprocal of(const kernels::PatchSlopes<Lane>& s) {
    const Lane a = dot(s.u, s.u), b = dot(s.u, s.v), c = dot(s.v, s.v);
    const Lane inv_det = 1.0 / fma(a, c, -(b * b));
    return {inv_det * (c * s.u - b * s.v), inv_det * (a * s.v - b * s.u)};
  }
};

// Motion of the points relative to the other surface, given its velocity and slopes.
inline void set_rates(const VectorLanes& velocity, const kernels::PatchSlopes<Lane>& other,
                      const Reciprocal& to, PointMotion& m) {
  const VectorLanes relative = velocity - other.x;
  const Lane closing = dot(relative, m.normal);
  const VectorLanes normal_rate = -(dot(other.u, m.normal) * to.u + dot(other.v, m.normal) * to.v);
  m.gap_rate = -closing;
  m.slip = fma(m.gap, normal_rate, fma(-closing, m.normal, relative));
  const Lane drill = 0.5 * dot(m.normal, cross(to.u, other.u) + cross(to.v, other.v));
  m.spin = cross(m.normal, normal_rate) + drill * m.normal;
}

// Of forces that act at a place of the other surface beside the closest point, `along` from it in its tangent plane.
inline OtherFaces::SlopeLoads slope_loads(const PointMotion& m, const VectorLanes& along,
                                          const VectorLanes& force, const Reciprocal& to) {
  const Lane push = dot(force, m.normal);
  const VectorLanes shear = fma(-push, m.normal, force);
  const VectorLanes moment = -fma(m.gap, shear, push * along);
  const Lane drill = -0.5 * dot(cross(along, shear), m.normal);
  const auto on_slope = [&](const VectorLanes& reciprocal) {
    return fma(dot(moment, reciprocal), m.normal, drill * cross(m.normal, reciprocal));
  };
  return {on_slope(to.u), on_slope(to.v)};
}

}  // namespace pulvis::space
