// stable_time_step: the largest time step that is stable for every element (and the contact springs on
// the outline) of a particle.
//
// Source   The highest frequency of an assembly is at most that of its worst element, however the nodal
//          masses are distributed among the adjacent elements (Irons; Flanagan & Belytschko 1984); the
//          shape distributes them to minimise the worst (scenes/meshes/mass_shares). Elements:
//          systems/body/time_step_kernel.hpp. An outline element also carries contact springs of k K L/A (a
//          tool's, or the half of it that two equal bodies share, moving against each other), and dashpots
//          lagging by half a step: stable while dt^2 omega^2 + 2 dt gamma <= 4 (systems/tools/servo_kernel.hpp).
// Runs     stable_time_step every few steps, while the stresses of a chunk are in cache
#include <span>

#include "components/run_state.hpp"
#include "engine/access.hpp"
#include "engine/entry.hpp"
#include "systems/body/element_bound.hpp"
#include "systems/body/systems.hpp"
#include "systems/body/time_step_kernel.hpp"

namespace pulvis {
namespace {

// rho omega^2 of the undamped element with the same stable step as an outline element with dashpots:
// gamma/2 + sqrt(gamma^2/4 + omega^2) for omega.
Lane late_frequency(const ContactRules& rules, double stiffening, const Shape& shape,
                    Row<Element> element, const Lane& bulk, const Lane& solid) {
  const double geometry = entry(shape.contact_frequency, element);
  const Lane springs = rules.stiffness * stiffening * geometry * bulk;
  const Lane half = 0.5 * dashpot_ratio(rules) * geometry /
                    softest_edge(shape, entry(shape.quads, element)) * sqrt(rules.stiffness * bulk);
  const Lane omega = half + sqrt(half * half + solid + springs);
  return omega * omega;
}

// visit(bound) for every element of a chunk, in order.
template <int Points, class Visit>
void visit_bounds(const stable_time_step<Points>& of, Chunk chunk, const Visit& visit) {
  const Row<Particle> particle;
  const Shape& shape = of.bodies->shape_of_chunk(chunk);
  const auto nodes = of.position.chunk(chunk);
  const auto stress = of.deviator.chunk(chunk);
  const Lane k = of.material.elastic.bulk.chunk(chunk)(particle),
             shear = of.material.elastic.shear.chunk(chunk)(particle), inv_shear = 1.0 / shear;
  const auto& rules = of.rules;
  const double stiffening = rules ? springs_of(chunk, *of.bodies, **rules, *of.clock) : 0;
  // Sufficient for low damping, within the margin of `safety`; with more damping, `late` gives the requirement.
  const double contact = rules ? (*rules)->stiffness * (stiffening + 2 * (*rules)->damping) : 0;
  const bool damped = rules && (*rules)->damping > 0;
  for (int i = 0; i < shape.elements(); ++i) {
    const Row<Element> e(i);
    const auto map = quad_map<4>(nodes, entry(shape.quads, e));
    const Lane theta =
        determinant(map_gradient<1>(map, 0)) * (4 / entry(shape.centre, e)[0].determinant);
    const auto spread =
        kernels::mode_spread(kernels::map_gradient(map, 0, 0), entry(shape.corner_moment, e));
    const Lane distortion = theta * inv_shear * largest_norm<Points>(stress, e);
    FrequencyBound bound;
    bound.alone =
        kernels::frequency_bound(spread, k, shear, theta, distortion) * corner_factor(map);
    bound.touching = bound.alone + contact * entry(shape.contact_frequency, e) * k;
    if (damped && entry(shape.contact_frequency, e) > 0)
      bound.late = late_frequency(**rules, stiffening, shape, e, k, bound.alone);
    visit(bound);
  }
}

}  // namespace

template <int Points>
[[gnu::flatten]] void stable_time_step<Points>::operator()(Chunk chunk) const {
  if (clock->step < clock->next_look) return;
  stable.chunk(chunk)(Row<Particle>()) = step_of_particles(
      *this, chunk, [&](const auto& visit) { visit_bounds(*this, chunk, visit); });
}

template <int Points>
StableSteps stable_time_step<Points>::of_elements(Chunk chunk) const {
  return steps_of_elements(*this, chunk,
                           [&](const auto& visit) { visit_bounds(*this, chunk, visit); });
}

template struct stable_time_step<1>;
template struct stable_time_step<4>;

}  // namespace pulvis
