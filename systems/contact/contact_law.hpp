// Contact law: forces on the touching points of two candidates, and what their columns store. Shared by pairs of
// particles and tools.
//
// Laws     systems/laws/normal_contact.hpp (pressure, damping), systems/laws/friction.hpp
// Sign     force on the sampled edge: pressure along n, friction traction along t = (-n_y, n_x)
#pragma once

#include "systems/contact/contact_sums.hpp"
#include "systems/contact/systems.hpp"
#include "systems/laws/adhesion.hpp"
#include "systems/laws/friction.hpp"
#include "systems/laws/normal_contact.hpp"

namespace pulvis {

// ---- the law of a point -----------------------------------------------------------------------------
struct PointLaw {
  Lane weight;      // m^2, undeformed tributary area of the point
  Lane kappa;       // Pa/m, in this pass
  Lane tangential;  // Pa/m, kappa of the tangential spring, in this pass
  Lane damping;     // Pa s/m, in this pass
  Lane inv_length;  // 1/m, of the edge
};

struct Frictionless {};

// `friction(slip, pressure)`: response of the friction law to the slip [m] of the step, or Frictionless.
template <class Friction>
[[gnu::always_inline]] inline PointForces forces_of(const PointLaw& law, const PointMotion& m,
                                                    double dt, const Friction& friction) {
  const auto normal =
      kernels::normal_traction(m.gap, m.gap_rate, law.kappa, law.damping, law.inv_length);
  PointForces f{};
  f.energy = normal.spring_energy;
  f.pressure = normal.pressure;
  if constexpr (!std::is_same_v<Friction, Frictionless>) {
    const kernels::Friction<Lane> tangential = friction(m.slip_rate * dt, normal.pressure);
    f.elastic_slip = tangential.elastic_slip;
    f.along = tangential.traction * law.weight;
    f.friction_work = tangential.work * law.weight;
    f.energy = fma(0.5 * law.tangential * f.elastic_slip, f.elastic_slip, f.energy);
  }
  f.energy *= law.weight;
  const Lane push = normal.pressure * law.weight;
  f.x = fma(push, m.nx, -(f.along * m.ny));
  f.y = fma(push, m.ny, f.along * m.nx);
  f.damping_work = normal.damping_power * law.weight * dt;
  return f;
}

// ---- from and to the columns --------------------------------------------------------------------------
// A candidate's points that are not handled by a bond (bits): bond_forces stores the state of the others.
template <class At>
unsigned free_points(const RowColumns<At>& c, Row<At> row) {
  return all_of_a_half & ~(c.bonding ? unsigned{c.bonding->bonded(row)} : 0U);
}
// Stores the given points of a half (bits); the others keep their values.
inline void store_points(unsigned points, const Lane& now, int half, double* four) {
  if (points == all_of_a_half)
    store_half(now, half, four);
  else
    for (int g = 0; g < edge_points; ++g)
      if ((points >> g & 1) != 0) four[g] = now[half * edge_points + g];
}

// A candidate whose points are all apart: no force acts, and none can before the surfaces have moved by `activation`.
template <class At>
void set_apart(const RowColumns<At>& c, Row<At> row, double activation) {
  c.state.touches(row) = 0;
  c.state.activation(row) = activation;
  const unsigned free = free_points(c, row);
  for (int k = 0; k < 2 * edge_points; ++k) c.force(row, k) = 0;
  for (int k = 0; k < edge_points; ++k) {
    if ((free >> k & 1) == 0) continue;
    if (c.sliding) c.sliding->elastic_slip(row, k) = 0;
    if (c.sliding && c.sliding->lost) (*c.sliding->lost)(row, k) = 0;
    if (c.bonding && c.bonding->weld) (*c.bonding->weld)(row, k) = 0;
  }
}

// The narrow phase treats bonded points as apart: bond_forces handles them.
template <class At>
LaneMask bonded_lanes(const RowColumns<At>& c, const TwoCandidates<At>& two) {
  const unsigned low = c.bonding->bonded(two[0]), high = c.bonding->bonded(two[1]);
  return LaneMask::of(low | high << edge_points);
}
template <class At>
[[gnu::always_inline]] inline void pass_over_bonded(const RowColumns<At>& c,
                                                    const TwoCandidates<At>& two,
                                                    PointMotion& motion) {
  if (c.bonding) motion.gap = select(bonded_lanes(c, two), Lane{} - 1.0, motion.gap);
}

struct Slip {
  Lane distance, rate, gap;  // m per step, m/s, m
};
struct TangentSpring {
  Lane kappa, inv_kappa;  // Pa/m, in this pass, and its inverse
};

// `number(laws)` of the surfaces of two candidates.
template <class At, class Number>
Lane of_surfaces(const RowColumns<At>& c, const TwoCandidates<At>& two, const Number& number) {
  return halves(number(c.surfaces->of(two[0])), number(c.surfaces->of(two[1])));
}

// Friction response of two candidates; stores the sliding state of those that touch (bits 0 and 1).
// Used by the narrow phase, where bonded points have no spring to release; bond_forces passes none that touch.
// `share` of kappa: one half if the other particle is sampled too.
template <class At>
kernels::Friction<Lane> friction_of(const RowColumns<At>& c, const TwoCandidates<At>& two,
                                    unsigned touching, double share, const Slip& slip,
                                    const Lane& pressure, const TangentSpring& spring) {
  const auto& sliding = *c.sliding;
  Lane before = at_points(sliding.elastic_slip, two);
  if (c.bonding && touching != 0) before = select(bonded_lanes(c, two), Lane{}, before);
  const Lane mu = at_candidates(c.law, two, ContactLaw<At>::friction);
  if (!sliding.lost) {
    kernels::Coulomb<Lane> law{mu};
    return kernels::friction_return(before, slip.distance, pressure, law, spring.kappa,
                                    spring.inv_kappa);
  }
  auto law = kernels::weakening<Lane>(
      [&](const auto& number) {
        return of_surfaces(c, two, [&](const SurfaceLaws& of) { return number(of.friction); });
      },
      share, at_points(*sliding.lost, two), abs(slip.rate));
  const auto friction = kernels::friction_return(before, slip.distance, pressure, law, spring.kappa,
                                                 spring.inv_kappa);
  // A point that is apart regains its static friction; one in its indentation is not apart.
  const Lane lost = select(slip.gap > 0.0, law.lost, Lane{});
  for (int half = 0; half < 2; ++half)
    if ((touching >> half & 1) != 0)
      store_points(free_points(c, entry(two, half)), lost, half,
                   &(*sliding.lost)(entry(two, half)));
  return friction;
}

// Gaps below which the two candidates carry a force.
template <class At>
Lane range_of(const RowColumns<At>& c, const TwoCandidates<At>& two) {
  if (!c.surfaces) return {};
  return of_surfaces(c, two, [](const SurfaceLaws& of) { return of.adhesion.range; });
}

// `weight` m^2, in this pass.
template <class At>
void attract(const RowColumns<At>& c, const TwoCandidates<At>& two, const PointMotion& m,
             const Lane& weight, PointForces& f) {
  const auto pull = kernels::attraction<Lane>(m.gap, [&](const auto& number) {
    return of_surfaces(c, two, [&](const SurfaceLaws& of) { return number(of.adhesion); });
  });
  f.x -= pull.traction * weight * m.nx;
  f.y -= pull.traction * weight * m.ny;
  f.energy += pull.energy * weight;
}

// `pressing`: the motion, with the gap from an indentation on where surfaces indent.
template <class At>
[[gnu::always_inline]] inline PointForces forces_of(const RowColumns<At>& c,
                                                    const TwoCandidates<At>& two, unsigned touching,
                                                    const PointMotion& m,
                                                    const PointMotion& pressing, double share,
                                                    double dt) {
  using Law = ContactLaw<At>;
  const double tangential = c.sliding ? c.sliding->rules->tangential : 1;
  const std::array<double, 2> stiffness{share * c.law(two[0], Law::stiffness),
                                        share * c.law(two[1], Law::stiffness)};
  const std::array<double, 2> sliding{tangential * stiffness[0], tangential * stiffness[1]};
  const PointLaw law{at_points(c.law, two, Law::weight), halves(stiffness[0], stiffness[1]),
                     halves(sliding[0], sliding[1]),
                     share * at_candidates(c.law, two, Law::damping),
                     at_candidates(c.law, two, Law::inv_size)};
  PointForces f =
      c.sliding
          ? forces_of(law, pressing, dt,
                      [&](const Lane& slip, const Lane& pressure) {
                        return friction_of(
                            c, two, touching, share, Slip{slip, pressing.slip_rate, m.gap},
                            pressure, {law.tangential, halves(1 / sliding[0], 1 / sliding[1])});
                      })
          : forces_of(law, pressing, dt, Frictionless{});
  if (c.surfaces && c.surfaces->rules->reach > 0) attract(c, two, m, share * law.weight, f);
  return f;
}

template <class At>
[[gnu::always_inline]] inline void keep(const RowColumns<At>& c, Row<At> row, int half,
                                        const PointForces& f, double share) {
  c.state.touches(row) = 1;
  c.state.activation(row) = 0;
  store_pairs_of_half(f.x, f.y, half, &c.force(row));
  const unsigned free = free_points(c, row);
  if (c.sliding) store_points(free, f.elastic_slip, half, &c.sliding->elastic_slip(row));
  if (c.bonding && c.bonding->weld)
    store_points(free, (1 / share) * f.pressure, half, &(*c.bonding->weld)(row));
}

// Which of two candidates (bit 0, bit 1) touch, and which of these bear a force and count as contacts.
struct Acting {
  unsigned touching;
  unsigned bearing;
};

// Law, columns and sums for those of two candidates that touch. Returns their friction traction
// times weight [N] (needed for the slope load on the other body).
template <class At>
[[gnu::always_inline]] inline Lane act_by(const RowColumns<At>& c, const TwoCandidates<At>& two,
                                          const Acting& acting, const PointMotion& m,
                                          const PointMotion& pressing, double share, double dt,
                                          LaneSums& sums) {
  const PointForces f = forces_of(c, two, acting.touching, m, pressing, share, dt);
  sums.add(f, acting.touching);
  sums.add_depth(two, acting.bearing,
                 pressing.gap * at_candidates(c.law, two, ContactLaw<At>::inv_size));
  for (int half = 0; half < 2; ++half)
    if ((acting.touching >> half & 1) != 0) keep(c, entry(two, half), half, f, share);
  return f.along;
}

// Indents the free points of those that touch; bonded points keep their indentation.
template <class At>
PointMotion indented(const RowColumns<At>& c, const TwoCandidates<At>& two, unsigned touching,
                     PointMotion m, const kernels::Hardness<Lane>& hardness, double share,
                     LaneSums& sums) {
  using Law = ContactLaw<At>;
  const auto now = kernels::indentation(m.gap, at_points(*c.state.indentation, two), hardness,
                                        share, share * at_candidates(c.law, two, Law::stiffness),
                                        at_candidates(c.law, two, Law::inv_size));
  LaneMask acting = LaneMask::of(entry(lanes_of_halves, touching));
  if (c.bonding) acting = acting & ~bonded_lanes(c, two);
  sums.indentation_work += select(acting, now.work * at_points(c.law, two, Law::weight), Lane{});
  for (int half = 0; half < 2; ++half)
    if ((touching >> half & 1) != 0)
      store_points(free_points(c, entry(two, half)), now.depth, half,
                   &(*c.state.indentation)(entry(two, half)));
  m.gap -= now.depth;
  return m;
}

// Those of the touching whose points are not all inside their indentations, where nothing acts.
template <class At>
unsigned bearing_of(const RowColumns<At>& c, const TwoCandidates<At>& two, unsigned touching,
                    const PointMotion& pressing) {
  const unsigned points = (~(pressing.gap <= -range_of(c, two))).bits();  // NaN acts
  return touching & ((half_of(points, 0) != 0 ? 1U : 0U) | (half_of(points, 1) != 0 ? 2U : 0U));
}

// Kept apart: most scenes have no such surfaces.
template <class At, class FindHardness>
[[gnu::noinline, gnu::flatten]] Lane act_indenting(const RowColumns<At>& c,
                                                   const TwoCandidates<At>& two, unsigned touching,
                                                   const PointMotion& m, double share, double dt,
                                                   LaneSums& sums,
                                                   const FindHardness& find_hardness) {
  const PointMotion pressing = indented(c, two, touching, m, find_hardness(), share, sums);
  const Acting acting{touching, bearing_of(c, two, touching, pressing)};
  return act_by(c, two, acting, m, pressing, share, dt, sums);
}

// `find_hardness()`: of the surfaces at the points; asked only where surfaces indent.
template <class At, class FindHardness>
[[gnu::flatten]] Lane act(const RowColumns<At>& c, const TwoCandidates<At>& two, unsigned touching,
                          const PointMotion& m, double share, double dt, LaneSums& sums,
                          const FindHardness& find_hardness) {
  if (c.state.indentation)
    return act_indenting(c, two, touching, m, share, dt, sums, find_hardness);
  return act_by(c, two, {touching, touching}, m, m, share, dt, sums);
}

// The forces of contact on bonded points, whose indentation stays as it is.
template <class At>
PointForces forces_of_bonded(const RowColumns<At>& c, const TwoCandidates<At>& two,
                             const PointMotion& m, double share, double dt) {
  PointMotion pressing = m;
  if (c.state.indentation) pressing.gap -= at_points(*c.state.indentation, two);
  return forces_of(c, two, 0, m, pressing, share, dt);
}

// Prefetches a candidate's data: in a large powder they come from main memory, one line per column.
template <class At>
void fetch(const RowColumns<At>& c, Row<At> row) {
  const auto line = [row](const auto& column) { prefetch(&column(row)); };
  line(c.pair), line(c.law), line(c.force);
  if (c.state.indentation) line(*c.state.indentation);
  if (c.sliding) line(c.sliding->elastic_slip);
}

}  // namespace pulvis
