// Contact law: what eight points of a candidate bear, and what its columns keep of it. Alike for pairs of particles and for
// tools.
//
// Laws     systems/laws/normal_contact.hpp (pressure, damping), systems/laws/friction.hpp
// Slip     of the sampled point x_s against the material point x_m of the other surface, a gap g apart along its normal n:
//            w = (v_s - v_m)_t + g n',   n' = -sum_a (v_,a . n) a^a,   a: u, v;   a^a: reciprocal to the slopes
//          which vanishes in a common rigid motion. The same power makes friction T act on the other surface with -T at
//          x_m and with -g (T . a^a) n on its slope along a, so that angular momentum is kept across the gap
// Springs  turn with the other surface: with its normal, and about it with its spin
// Sign     force on the sampled face: pressure along n, friction in the plane across n
#pragma once

#include "components/space/contact.hpp"
#include "systems/laws/friction.hpp"
#include "systems/laws/normal_contact.hpp"
#include "systems/space/contact/systems.hpp"
#include "systems/space/contact/vector.hpp"

namespace pulvis::space {

using VectorLanes = kernels::Vector<Lane>;

// Eight of the sixteen points: those from 8 half on.
inline VectorLanes load_half(const double* numbers, int half) {
  const double* first = numbers + lane_count * half;
  return {Lane::load(first), Lane::load(first + face_points), Lane::load(first + 2 * face_points)};
}
inline void store_half(const VectorLanes& a, double* numbers, int half) {
  double* first = numbers + lane_count * half;
  a.x.store(first);
  a.y.store(first + face_points);
  a.z.store(first + 2 * face_points);
}

// ---- the law of a point -----------------------------------------------------------------------------
struct PointMotion {
  Lane gap;            // m, > 0 in penetration
  VectorLanes normal;  // outward, of the other surface
  Lane gap_rate{};     // m/s
  VectorLanes slip{};  // m/s, in the plane across the normal
  VectorLanes spin{};  // rad/s, of the other surface
};
struct PointLaw {
  Lane weight;                                // m^2, undeformed area that a point stands for
  double kappa, friction, damping, inv_size;  // of the pass
};
struct PointForces {
  VectorLanes force;     // N, on the sampled face
  VectorLanes friction;  // N, of it
  VectorLanes elastic_slip;
  Lane energy;         // J
  Lane friction_work;  // J, of this step
  Lane damping_work;   // J, of this step
};

// A spring, turned with the other surface in a step; its length stays.
inline VectorLanes turned(const VectorLanes& spring, const PointMotion& m, double dt) {
  const VectorLanes turn = fma(Lane(dt), cross(m.spin, spring), spring);
  const VectorLanes flat = fma(-dot(turn, m.normal), m.normal, turn);
  const Lane before = dot(spring, spring), now = dot(flat, flat);
  return select(now > 0.0, sqrt(before / now), Lane{}) * flat;
}

[[gnu::always_inline]] inline PointForces normal_forces(const PointLaw& law, const PointMotion& m,
                                                        double dt, Lane& pressure) {
  const auto normal = pulvis::kernels::normal_traction(m.gap, m.gap_rate, Lane(law.kappa),
                                                       Lane(law.damping), Lane(law.inv_size));
  pressure = normal.pressure;
  PointForces f{};
  f.energy = normal.spring_energy * law.weight;
  f.force = (normal.pressure * law.weight) * m.normal;
  f.damping_work = normal.damping_power * law.weight * dt;
  return f;
}

inline void add_friction(const PointLaw& law, const PointMotion& m, double dt, const Lane& pressure,
                         const VectorLanes& before, PointForces& f) {
  pulvis::kernels::Coulomb<Lane> coulomb{Lane(law.friction)};
  const auto friction =
      pulvis::kernels::friction_return_in_plane(turned(before, m, dt), Lane(dt) * m.slip, pressure,
                                                coulomb, Lane(law.kappa), Lane(1 / law.kappa));
  f.elastic_slip = friction.elastic_slip;
  f.friction = law.weight * friction.traction;
  f.force = f.force + f.friction;
  f.friction_work = friction.work * law.weight;
  f.energy = fma(0.5 * law.kappa * law.weight, dot(friction.elastic_slip, friction.elastic_slip),
                 f.energy);
}

// ---- from and to the columns --------------------------------------------------------------------------
// Nothing of what a half's columns hold acts.
template <class At>
void clear_half(const RowColumns<At>& c, Row<At> row, int half) {
  const VectorLanes none{Lane{}, Lane{}, Lane{}};
  store_half(none, &c.force(row), half);
  if (c.slip) store_half(none, &(*c.slip)(row), half);
}

// The sums of a block while it is looked at.
struct FaceSums {
  Lane energy{}, friction_work{}, damping_work{};
  BlockSums block;

  static double sum(const Lane& a) {
    std::array<double, lane_count> v;
    a.store(v.data());
    return ((v[0] + v[1]) + (v[2] + v[3])) + ((v[4] + v[5]) + (v[6] + v[7]));
  }
  static double greatest(const Lane& a) {
    std::array<double, lane_count> v;
    a.store(v.data());
    double greatest = v[0];
    for (const double x : v)
      if (!(x <= greatest)) greatest = x;
    return greatest;
  }
  void add(const PointForces& f) {
    energy += f.energy;
    friction_work += f.friction_work;
    damping_work += f.damping_work;
  }
  // The first depth that is no number, or the deepest.
  void book_depth(std::int32_t row, double depth) {
    if (depth <= block.depth || block.depth != block.depth) return;
    block.depth = depth;
    block.deepest = row;
  }
  BlockSums added_up() const {
    BlockSums sums = block;
    sums.energy = sum(energy);
    sums.friction_work = sum(friction_work);
    sums.damping_work = sum(damping_work);
    return sums;
  }
};

// How the halves of a candidate stand that touch (bit 0, bit 1); the others are apart.
struct RowMotion {
  std::array<PointMotion, 2> half;
  unsigned touching = 0;

  bool touches(int h) const { return (touching >> h & 1) != 0; }
};

// What the halves of a candidate that touch bear: law, columns, books. `share` of the stiffness: one half where the other
// particle samples back. Keeps the friction [N] of its points.
template <class At>
[[gnu::always_inline]] inline void act(const RowColumns<At>& c, Row<At> row,
                                       const Shape::Face& face, const RowMotion& motion,
                                       double share, double dt, FaceSums& sums,
                                       std::array<VectorLanes, 2>& friction) {
  using Law = ContactLaw<At>;
  const bool new_touch = c.touches(row) == 0;
  c.touches(row) = 1;
  sums.block.touching += 1;
  Lane deepest{};
  for (int half = 0; half < 2; ++half) {
    if (!motion.touches(half)) {
      clear_half(c, row, half);
      continue;
    }
    const PointMotion& m = entry(motion.half, half);
    const PointLaw law{Lane::load(face.weight.data() + lane_count * half),
                       share * c.law(row, Law::stiffness), c.law(row, Law::friction),
                       share * c.law(row, Law::damping), c.law(row, Law::inv_size)};
    Lane pressure;
    PointForces f = normal_forces(law, m, dt, pressure);
    if (c.slip) {
      double* spring = &(*c.slip)(row);
      add_friction(law, m, dt, pressure, new_touch ? VectorLanes{} : load_half(spring, half), f);
      store_half(f.elastic_slip, spring, half);
    }
    store_half(f.force, &c.force(row), half);
    sums.add(f);
    deepest = max(m.gap, deepest);
    entry(friction, half) = f.friction;
  }
  sums.book_depth(row.value, FaceSums::greatest(deepest) * c.law(row, Law::inv_size));
}

}  // namespace pulvis::space
