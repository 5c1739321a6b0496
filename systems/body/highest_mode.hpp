// highest_mode: stable time step of each particle as a whole, in place of that of its worst element.
//
// Source   Power iteration on M^-1 K (Rayleigh quotient), as in the global estimator of Abaqus/Explicit.
//          K at the current positions (of quads: highest_mode_kernel.hpp; of hexahedra:
//          systems/space/body/stiffness_kernel.hpp), with the whole outline or surface in
//          contact: no part of it is softer than what the step integrates, so that contacts may come and go
//          between two evaluations. The quotient converges from below, hence a margin. The stored value is
//          the ratio to the element bound, which itself follows the geometry at every evaluation; the mode
//          changes slowly, one iteration every fourth evaluation tracks it
// Runs     after stable_time_step, when that is evaluated
// Active   when the scene sets time.estimate = "highest-mode"
//
// The elastic forces of the elements, `subtract_stiffness`, are the only part that differs between two and three
// dimensions: highest_mode.cpp here, and systems/space/body/element_stiffness.cpp.
#pragma once

#include <limits>

#include "engine/entry.hpp"
#include "systems/body/element_bound.hpp"
#include "systems/body/systems.hpp"

namespace pulvis {

inline constexpr int first_iterations = 300;
inline constexpr double looks_between_iterations = 4;
inline constexpr double mode_margin = 0.98;  // 300 iterations leave an error of half a percent
inline constexpr double longest_gain = 1.3;  // over the element bound; undeformed discs reach 1.2

template <class D>
using ModeView = ChunkView<HighestMode<D>, Lane*>;

// F: the formulation of the elements.
template <class F>
struct ModeBody {
  using D = typename F::Dimension;
  const typename D::Shape& shape;
  ChunkView<Position<D>, const Lane*> x;
  ChunkView<DeviatoricStress<D, F::points>, const Lane*> stress;
  const ChunkView<ContactSupport, const Lane*>* support;  // null: no contact possible
  Lane bulk, shear, contact;                              // Pa
};

// -K v, after v in the columns of the mode; in two dimensions for unit slice depth.
template <class F>
void elastic_forces(const ModeBody<F>& body, const ModeView<typename F::Dimension>& mode) {
  constexpr int axes = F::Dimension::axes;
  for (int i = 0; i < static_cast<int>(body.shape.nodes.size()); ++i) {
    const Row<Node> n(i);
    const Lane spring = body.support && i < body.shape.boundary_nodes
                            ? body.contact * (*body.support)(Row<BoundaryNode>(i))
                            : Lane{};
    for (int k = 0; k < axes; ++k) mode(n, axes + k) = -(spring * mode(n, k));
  }
  for (int i = 0; i < body.shape.elements(); ++i) subtract_stiffness(body, Row<Element>(i), mode);
}

// One iteration; returns rho omega^2 of the current mode, Pa/m^2.
template <class F>
Lane iterate(const ModeBody<F>& body, const ModeView<typename F::Dimension>& mode) {
  constexpr int axes = F::Dimension::axes;
  elastic_forces(body, mode);
  const auto nodes = static_cast<int>(body.shape.nodes.size());
  Lane energy{}, mass{};
  for (int i = 0; i < nodes; ++i)
    for (int k = 0; k < axes; ++k) {
      const Lane v = mode(Row<Node>(i), k);
      energy -= v * mode(Row<Node>(i), axes + k);
      mass += body.shape.size_of_node(i) * (v * v);
    }
  const Lane quotient = energy / mass;
  // Shifted by somewhat less than half of the spectrum, which extends from zero to the quotient: the
  // other modes decay twice as fast.
  const Lane shift = 0.45 * quotient, scale = 1.0 / (quotient * sqrt(mass));
  for (int i = 0; i < nodes; ++i)
    for (int k = 0; k < axes; ++k) {
      Lane& v = mode(Row<Node>(i), k);
      v = -(scale * (mode(Row<Node>(i), axes + k) * (1 / body.shape.size_of_node(i)) + shift * v));
    }
  return quotient;
}

// 1/m, of the edges, or faces, on the outline.
inline double softest_support(const Shape& shape) {
  double softest = std::numeric_limits<double>::infinity();
  for (const Shape::Edge& edge : shape.edges) softest = std::min(softest, edge.stiffness);
  return softest;
}
inline double softest_support(const space::Shape& shape) {
  double softest = std::numeric_limits<double>::infinity();
  for (const space::Shape::Face& face : shape.faces) softest = std::min(softest, face.stiffness);
  return softest;
}

// k K of the springs on the outline. A dashpot c lagging by half a step counts like a spring of 2 c/dt; no step
// is shorter than the element bound, which stands in for dt.
template <class AnyShape>
Lane contact_modulus(const ContactRules& rules, double stiffening, const AnyShape& shape,
                     const Lane& bulk, const Lane& rho, const Lane& step) {
  // With less damping than this, blocks are stable for stiffness 0.35 to 100 within the margin of the spring bound.
  constexpr double little_damping = 0.3;
  if (rules.damping == 0 || (!rules.servos && rules.damping <= little_damping))
    return rules.stiffness * (stiffening + 2 * rules.damping) * bulk;
  return rules.stiffness * stiffening * bulk + (2 * dashpot_ratio(rules) / softest_support(shape)) *
                                                   sqrt(rules.stiffness * bulk * rho) / step;
}

template <class F>
[[gnu::flatten]] void highest_mode<F>::operator()(Chunk chunk) const {
  if (clock->step < clock->next_look) return;
  const auto known = estimate.gain.chunk(chunk);
  const Row<Particle> particle;
  Lane& step = estimate.stable.chunk(chunk)(particle);
  if (clock->step > 0 && known(particle, 1)[0] < looks_between_iterations) {
    known(particle, 1) += 1.0;
    step *= known(particle, 0);
    return;
  }
  const Lane k = material.elastic.bulk.chunk(chunk)(particle),
             rho = material.density.chunk(chunk)(particle);
  const auto& shape = bodies.shape_of(chunk);
  const Lane contact =
      springs ? contact_modulus(*springs->rules,
                                springs_of(chunk, *bodies.bodies, *springs->rules, *clock), shape,
                                k, rho, step)
              : Lane{};
  ModeBody<F> body{shape,
                   position.chunk(chunk),
                   deviator.chunk(chunk),
                   nullptr,
                   k,
                   material.elastic.shear.chunk(chunk)(particle),
                   contact};
  using Support = ChunkView<ContactSupport, const Lane*>;
  const Support support = springs ? springs->support.chunk(chunk) : Support(nullptr);
  if (springs) body.support = &support;

  Lane highest{};
  for (int i = 0; i < (clock->step == 0 ? first_iterations : 1); ++i)
    highest = iterate(body, estimate.mode.chunk(chunk));
  const Lane longest = mode_margin * stable_step(chunk, rho, highest, damping);
  known(particle, 0) = max(1.0, min(longest / step, longest_gain));
  known(particle, 1) = 1.0;
  step *= known(particle, 0);
}

}  // namespace pulvis
