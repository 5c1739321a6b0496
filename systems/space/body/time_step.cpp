// stable_time_step: the largest time step that is stable for all elements of a particle (and the contact springs on
// their faces).
//
// Source   The highest frequency of an assembly is at most that of its worst element, however the nodal masses are
//          divided among the adjacent elements (Irons; Flanagan & Belytschko 1984). Elements:
//          systems/space/body/time_step_kernel.hpp. One on the surface also carries contact springs of k K s, and
//          dashpots that lag by half a step: as in systems/body/time_step.cpp
// Runs     every few steps, while the stresses of a chunk are in cache
#include "components/run_state.hpp"
#include "engine/access.hpp"
#include "engine/entry.hpp"
#include "systems/body/element_bound.hpp"
#include "systems/space/body/element_bound.hpp"
#include "systems/space/body/systems.hpp"
#include "systems/space/body/time_step_kernel.hpp"

namespace pulvis::space {
namespace {

// Gradients at the Gauss points of a hexahedron are at most (4/3)^2 times those at the centre; this is for the square.
constexpr double of_eight_points = 16.0 / 9.0;

template <int Points, class View>
Lane largest_stress(const View& stress, Row<Element> e) {
  Lane maximum{};
  for (int g = 0; g < Points; ++g)
    maximum = max(maximum, kernels::squared_norm(deviator_at(stress, e, g)));
  return sqrt(maximum);
}

// An element with an inverting corner has a higher frequency there than its centre suggests, by about the square of how
// much smaller the map is at that Gauss point: at most 9, so that a corner about to invert does so (and is
// reported) instead of driving the time step to zero.
Lane gauss_factor(const kernels::ElementModes<Lane>& modes, const kernels::GaussPoints& points,
                  const Lane& j) {
  const Lane least = min(kernels::least_of(kernels::gauss_determinants(modes, points)), j);
  const Lane ratio = j / max(least, 1e-300);
  return of_eight_points * min(ratio * ratio, 9.0);
}

struct Contact {
  double springs = 0;   // k, of the springs including the effect of light damping
  double stiff = 0;     // k of the springs alone
  double dashpots = 0;  // 2 xi of a pair
  double base = 0;      // k of the scene, without stiffening
};

// gamma/2 + sqrt(gamma^2/4 + omega^2) for omega, squared; times rho.
Lane late_bound(const Contact& contact, const Shape::Element& element, Lane bulk, Lane solid) {
  const Lane half = (0.5 * contact.dashpots * element.contact_drag) * sqrt(contact.base * bulk);
  const Lane omega =
      half + sqrt(half * half + solid + contact.stiff * element.contact_frequency * bulk);
  return omega * omega;
}

// visit(bound) for every element of a chunk, in order.
template <class F, class Visit>
void visit_bounds(const stable_time_step<F>& of, Chunk chunk, const Visit& visit) {
  const Row<Particle> particle;
  const Shape& shape = of.bodies.shape_of(chunk);
  const auto nodes = of.position.chunk(chunk);
  const auto stress = of.deviator.chunk(chunk);
  const Lane k = of.material.elastic.bulk.chunk(chunk)(particle),
             mu = of.material.elastic.shear.chunk(chunk)(particle);
  Contact contact;
  if (const auto& rules = of.rules) {
    const double stiffening = springs_of(chunk, *of.bodies.bodies, **rules, *of.clock);
    contact = {(*rules)->stiffness * (stiffening + 2 * (*rules)->damping),
               (*rules)->stiffness * stiffening, dashpot_ratio(**rules), (*rules)->stiffness};
  }
  for (int i = 0; i < shape.elements(); ++i) {
    const Shape::Element& element = entry(shape.element, i);
    const auto modes = element_modes(nodes, entry(shape.hexahedra, i));
    const auto f = kernels::deformation_gradient(modes, element.gradient);
    FrequencyBound bound;
    bound.alone = kernels::frequency_bound(element, f, k, mu,
                                           largest_stress<F::points>(stress, Row<Element>(i)));
    if constexpr (F::stabilised)
      bound.alone *= closing_factor(modes, f, element, entry(shape.gauss, i));
    else
      bound.alone *=
          gauss_factor(modes, entry(shape.gauss, i), kernels::determinant(f, kernels::adjugate(f)));
    bound.touching = bound.alone + contact.springs * element.contact_frequency * k;
    if (contact.dashpots > 0 && element.contact_drag > 0)
      bound.late = late_bound(contact, element, k, bound.alone);
    visit(bound);
  }
}

}  // namespace

template <class F>
[[gnu::flatten]] void stable_time_step<F>::operator()(Chunk chunk) const {
  if (clock->step < clock->next_look) return;
  stable.chunk(chunk)(Row<Particle>()) = step_of_particles(
      *this, chunk, [&](const auto& visit) { visit_bounds(*this, chunk, visit); });
}

template <class F>
StableSteps stable_time_step<F>::of_elements(Chunk chunk) const {
  return steps_of_elements(*this, chunk,
                           [&](const auto& visit) { visit_bounds(*this, chunk, visit); });
}

template struct stable_time_step<OnePoint>;
template struct stable_time_step<EightPoint>;

}  // namespace pulvis::space
