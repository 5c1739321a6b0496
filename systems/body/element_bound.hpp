// What both estimates of the stable time step account for in an element besides its moduli.
#pragma once

#include <limits>

#include "components/bundles.hpp"
#include "engine/entry.hpp"
#include "systems/body/element_access.hpp"
#include "systems/body/systems.hpp"
#include "systems/body/time_step_kernel.hpp"

namespace pulvis {

// Of the highest mode over the element bound: undeformed discs reach 1.2. It counts the contact springs as if there were no inerters, which
// make up for stiff ones.
inline constexpr double longest_gain = 1.3, longest_with_inerters = 3;

// Largest norm of the deviatoric stress at the Gauss points of an element.
template <int Points, class View>
Lane largest_norm(const View& stress, Row<Element> e) {
  Lane maximum{};
  for (int g = 0; g < Points; ++g) {
    const auto s = deviator(stress, e, g);
    maximum =
        max(maximum, s.xx * s.xx + s.yy * s.yy + (s.xx + s.yy) * (s.xx + s.yy) + 2.0 * s.xy * s.xy);
  }
  return sqrt(maximum);
}

// A quad with a collapsing corner oscillates faster there than its centre indicates: by about the square of how
// much smaller the map is at that Gauss point, which carries a quarter of the energy (half, to be safe). One for
// all elements that are not badly distorted; at most 9, so that a corner about to invert does invert (and is
// reported) instead of stalling the time step.
inline Lane corner_factor(const kernels::QuadMap<Lane>& map) {
  Lane minimum = determinant(map_gradient<4>(map, 0));
  for (int g = 1; g < 4; ++g) minimum = min(minimum, determinant(map_gradient<4>(map, g)));
  const Lane ratio = determinant(map_gradient<1>(map, 0)) / max(minimum, 1e-300);
  return min(max(1.0, 0.5 * ratio * ratio), 9.0);
}

// Stable step of particles with that highest rho omega^2, bulk damping included.
inline Lane stable_step(Chunk chunk, Lane density, Lane highest,
                        const Optional<BulkDamping>& damping) {
  if (!damping) return 2.0 * sqrt(density / highest);
  const Row<Particle> particle;
  return kernels::damped_step<Lane>(highest / density, damping->mass.chunk(chunk)(particle),
                                    damping->stiffness.chunk(chunk)(particle));
}

// Upper bounds on rho omega^2 of an element; of a particle, the largest of its elements. Pa/m^2
struct FrequencyBound {
  Lane alone{};     // without contact
  Lane touching{};  // with contact springs on its outline, or surface
  Lane late{};      // with contact dashpots, which lag by half a step; zero without any

  void include(const FrequencyBound& of_another) {
    alone = max(alone, of_another.alone);
    touching = max(touching, of_another.touching);
    late = max(late, of_another.late);
  }
};

// The stable step that the same bounds allow. With a servo it keeps the entire margin that `safety` leaves for dashpots;
// without one, the known overestimate of their bound need not reduce it: damped blocks on plates and on each other
// (stiffness 0.35 to 100, damping 0.3 to 1) become unstable from 1.36 times what it allows.
inline Lane stable_step(Chunk chunk, Lane density, const FrequencyBound& bound,
                        const Optional<BulkDamping>& damping,
                        const Optional<Read<ContactRules>>& rules, double safety) {
  constexpr double dashpots_too_strict = 1.25;
  const Lane step = stable_step(chunk, density, bound.touching, damping);
  if (!rules || (*rules)->damping == 0) return step;
  const Lane longest = stable_step(chunk, density, bound.late, damping);
  return (*rules)->servos ? min(longest, step) : min(dashpots_too_strict / safety * longest, step);
}

// `system`: stable_time_step; bounds(visit): calls visit(bound) for every element. Of each particle of the chunk.
template <class System, class Bounds>
Lane step_of_particles(const System& system, Chunk chunk, const Bounds& bounds) {
  FrequencyBound worst;
  bounds([&](const FrequencyBound& bound) { worst.include(bound); });
  const Lane density = system.material.density.chunk(chunk)(Row<Particle>());
  return stable_step(chunk, density, worst, system.damping, system.rules, system.clock->safety);
}

// The same of each element.
template <class System, class Bounds>
StableSteps steps_of_elements(const System& system, Chunk chunk, const Bounds& bounds) {
  const Lane density = system.material.density.chunk(chunk)(Row<Particle>());
  StableSteps steps;
  bounds([&](const FrequencyBound& bound) {
    steps.alone.push_back(stable_step(chunk, density, bound.alone, system.damping));
    steps.touching.push_back(
        stable_step(chunk, density, bound, system.damping, system.rules, system.clock->safety));
  });
  return steps;
}

// Minimum L/A over the element's edges on the outline; infinite if it has none.
inline double softest_edge(const Shape& shape, const Quad& quad) {
  double minimum = std::numeric_limits<double>::infinity();
  for (std::size_t c = 0; c < 4; ++c) {
    const int from = quad[c].value, to = quad[(c + 1) % 4].value;
    if (from < shape.boundary_nodes && to == (from + 1) % shape.boundary_nodes)
      minimum = std::min(minimum, entry(shape.edges, from).stiffness);
  }
  return minimum;
}

// Tangent of the stiffest spring on a chunk's outlines relative to an undeformed contact spring, bonds included.
inline double springs_of(Chunk chunk, const Bodies& bodies, const ContactRules& rules,
                         const Clock& clock) {
  return rules.springs_of(entry(bodies.slots, ChunkLane(chunk, 0).slot()).material,
                          clock.stiffening);
}

// Ratio of contact dashpots to contact springs of k K L/A, times sqrt(kK/rho) L/A: 2 xi with a tool. Two equal
// bodies moving against each other feel twice the dashpot of half the spring: sqrt(2) times that.
inline double dashpot_ratio(const ContactRules& rules) {
  constexpr double of_pairs = 1.4142135623730951;
  return of_pairs * 2 * rules.damping;
}

}  // namespace pulvis
