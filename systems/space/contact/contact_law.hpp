// Contact law: forces on eight points. The same for pairs of particles and for tools.
//
// Laws     systems/laws/normal_contact.hpp (pressure, damping), systems/laws/friction.hpp, systems/laws/adhesion.hpp
// Slip     of the sampled point x_s against the material point x_m of the other surface, a gap g apart along its normal n:
//            w = (v_s - v_m)_t + g n',   n' = -sum_a (v_,a . n) a^a,   a: u, v;   a^a: reciprocal to the slopes
//          which vanishes in a common rigid motion. By virtual power, friction T acts on the other surface with -T at
//          x_m and with -g (T . a^a) n on its slope along a, so that angular momentum is conserved across the gap
// Springs  rotate with the other surface: with its normal, and about it with its spin
// Sign     force on the sampled face: pressure along n, friction in the plane normal to n
#pragma once

#include "components/run_state.hpp"
#include "components/space/contact.hpp"
#include "systems/laws/adhesion.hpp"
#include "systems/laws/friction.hpp"
#include "systems/laws/normal_contact.hpp"
#include "systems/space/contact/systems.hpp"
#include "systems/space/contact/vector.hpp"

namespace pulvis::space {

using VectorLanes = kernels::Vector<Lane>;

// Eight of the sixteen points, starting at 8 half.
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
  VectorLanes slip{};  // m/s, in the tangent plane
  VectorLanes spin{};  // rad/s, of the other surface
  Lane overlap{};      // m, <= 0: of surfaces bonded at the start; contact counts from it
  Lane indentation{};  // m, >= 0: of surfaces that indent; what presses counts from it

  Lane depth() const { return gap + overlap; }
  Lane pressing() const { return depth() - indentation; }
};
struct PointLaw {
  Lane kappa, friction, damping, inv_size;  // of the pass
  Lane weight;                              // m^2, undeformed area of a point
  Lane tangential;                          // Pa/m, kappa of the tangential springs
};
struct PointForces {
  VectorLanes force;     // N, on the sampled face
  VectorLanes friction;  // N, friction part of it
  VectorLanes elastic_slip;
  Lane energy;              // J
  Lane friction_work;       // J, in this step
  Lane damping_work;        // J, in this step
  Lane indentation_work{};  // J, in this step
};

// A spring rotated with the other surface over a step; its length is unchanged.
inline VectorLanes turned(const VectorLanes& spring, const PointMotion& m, double dt) {
  const VectorLanes turn = fma(Lane(dt), cross(m.spin, spring), spring);
  const VectorLanes flat = fma(-dot(turn, m.normal), m.normal, turn);
  const Lane before = dot(spring, spring), now = dot(flat, flat);
  return select(now > 0.0, sqrt(before / now), Lane{}) * flat;
}

// Where surfaces indent: `m` gets the indentation of its points; returns J/m^2, spent in this step. `before` m; `share` of
// the pressure that the pass bears.
inline Lane indent(const PointLaw& law, const Lane& before,
                   const pulvis::kernels::Hardness<Lane>& hardness, double share, PointMotion& m) {
  const auto indented =
      pulvis::kernels::indentation(m.depth(), before, hardness, share, law.kappa, law.inv_size);
  m.indentation = indented.depth;
  return indented.work;
}

[[gnu::always_inline]] inline PointForces normal_forces(const PointLaw& law, const PointMotion& m,
                                                        double dt, Lane& pressure) {
  const auto normal = pulvis::kernels::normal_traction(m.pressing(), m.gap_rate, law.kappa,
                                                       law.damping, law.inv_size);
  pressure = normal.pressure;
  const VectorLanes none{Lane{}, Lane{}, Lane{}};
  return {
      (normal.pressure * law.weight) * m.normal, none,   none,
      normal.spring_energy * law.weight,         Lane{}, normal.damping_power * law.weight * dt};
}

// `share` of the attraction in this pass, for each point. Friction follows the contact pressure alone.
inline void attract(const PointLaw& law, const PointMotion& m, const AdhesionParameters& adhesion,
                    const Lane& share, PointForces& f) {
  const auto pull = pulvis::kernels::attraction<Lane>(
      m.depth(), [&](const auto& number) { return Lane(number(adhesion)); });
  f.force = fma(-(share * pull.traction * law.weight), m.normal, f.force);
  f.energy = fma(share * pull.energy, law.weight, f.energy);
}

// `sliding`: the friction law (systems/laws/friction.hpp). `before`: the springs.
template <class Sliding>
void add_friction(const PointLaw& law, const PointMotion& m, double dt, const Lane& pressure,
                  const VectorLanes& before, Sliding& sliding, PointForces& f) {
  const auto friction =
      pulvis::kernels::friction_return_in_plane(turned(before, m, dt), Lane(dt) * m.slip, pressure,
                                                sliding, law.tangential, 1.0 / law.tangential);
  f.elastic_slip = friction.elastic_slip;
  f.friction = law.weight * friction.traction;
  f.force = f.force + f.friction;
  f.friction_work = friction.work * law.weight;
  f.energy = fma(0.5 * law.tangential * law.weight,
                 dot(friction.elastic_slip, friction.elastic_slip), f.energy);
}

// For pairs whose friction is more than a Coulomb coefficient.
struct WeakeningPass {
  const FrictionParameters& of_pair;
  double share;  // of the shear strength: one half if the other particle samples back
  Lane lost;     // of the static part of friction
};

// Returns the loss of the static part: zero where the surfaces are apart. One in its indentation is not apart.
[[gnu::noinline]] inline Lane add_weakening_friction(const WeakeningPass& pass, const PointLaw& law,
                                                     const PointMotion& m, double dt,
                                                     const Lane& pressure,
                                                     const VectorLanes& before, PointForces& f) {
  auto sliding = pulvis::kernels::weakening<Lane>(
      [&](const auto& number) { return Lane(number(pass.of_pair)); }, pass.share, pass.lost,
      sqrt(dot(m.slip, m.slip)));
  add_friction(law, m, dt, pressure, before, sliding, f);
  return select(m.depth() > 0.0, sliding.lost, Lane{});
}

// ---- sums -----------------------------------------------------------------------------------------------
// The sums of a block while it is processed.
struct FaceSums {
  Lane energy{}, friction_work{}, damping_work{}, indentation_work{};
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
    indentation_work += f.indentation_work;
  }
  // Keeps the first depth that is NaN, or else the deepest.
  void record_depth(std::int32_t row, double depth) {
    if (depth <= block.depth || block.depth != block.depth) return;
    block.depth = depth;
    block.deepest = row;
  }
  BlockSums added_up() const {
    BlockSums sums = block;
    sums.energy = sum(energy);
    sums.friction_work = sum(friction_work);
    sums.damping_work = sum(damping_work);
    sums.indentation_work = sum(indentation_work);
    return sums;
  }
};

}  // namespace pulvis::space
