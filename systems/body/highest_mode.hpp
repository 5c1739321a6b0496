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

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "engine/entry.hpp"
#include "systems/body/element_bound.hpp"
#include "systems/body/inerter_chains.hpp"
#include "systems/body/systems.hpp"

namespace pulvis {

inline constexpr int first_iterations = 300;
// Each begins with the mode of the one before, which another step of the dashpots hardly changes.
inline constexpr int rounds_with_dashpots = 3, iterations_of_round = 60;
inline constexpr double looks_between_iterations = 4;
inline constexpr double mode_margin = 0.98;  // 300 iterations leave an error of half a percent

template <class D>
using ModeView = ChunkView<HighestMode<D>, Lane*>;

// F: the formulation of the elements.
template <class F>
struct ModeBody {
  using D = typename F::Dimension;
  const typename D::Shape& shape;
  ChunkView<Position<D>, const Lane*> x;
  ChunkView<DeviatoricStress<D, F::points>, const Lane*> stress;
  Lane bulk, shear;  // Pa
  struct Contact {
    ChunkView<ContactSupport, const Lane*> support;
    std::vector<std::array<Lane, D::axes>> normal;  // [boundary nodes] of the outline or surface
    Lane along_normal, tangential;                  // Pa
  };
  std::optional<Contact> contact;  // if possible
  std::optional<ChunkView<Inertance, const Lane*>> inertance;
};

// Not normalised: weighted with the size of the edges or faces at the node.
template <class Positions>
std::vector<std::array<Lane, 2>> boundary_normals(const Shape& shape, const Positions& x) {
  std::vector<std::array<Lane, 2>> normal(static_cast<std::size_t>(shape.boundary_nodes));
  for (const Shape::Edge& edge : shape.edges)
    for (const Row<Node> end : edge.ends) {
      auto& n = entry(normal, end.value);
      n[0] += x(edge.ends[1], 1) - x(edge.ends[0], 1);
      n[1] += x(edge.ends[0], 0) - x(edge.ends[1], 0);
    }
  return normal;
}
template <class Positions>
std::vector<std::array<Lane, 3>> boundary_normals(const space::Shape& shape, const Positions& x) {
  std::vector<std::array<Lane, 3>> normal(static_cast<std::size_t>(shape.boundary_nodes));
  for (const space::Shape::Face& face : shape.faces) {
    const auto diagonal = [&](std::size_t from, std::size_t to, int k) -> Lane {
      return x(Row<Node>(face.corner[to].value), k) - x(Row<Node>(face.corner[from].value), k);
    };
    std::array<Lane, 3> p, q;
    for (int k = 0; k < 3; ++k) {
      entry(p, k) = diagonal(0, 2, k);
      entry(q, k) = diagonal(1, 3, k);
    }
    for (const Row<BoundaryNode> corner : face.corner)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
        entry(normal, corner.value)[k] += p[i] * q[j] - p[j] * q[i];
      }
  }
  return normal;
}

// -K v of the contact springs, after v in the columns of the mode; in two dimensions for unit slice depth.
template <class F>
void spring_forces(const ModeBody<F>& body, const ModeView<typename F::Dimension>& mode) {
  constexpr int axes = F::Dimension::axes;
  for (int i = 0; i < static_cast<int>(body.shape.nodes.size()); ++i)
    for (int k = 0; k < axes; ++k) mode(Row<Node>(i), axes + k) = Lane{};
  for (int i = 0; body.contact && i < body.shape.boundary_nodes; ++i) {
    const Row<Node> n(i);
    const auto& normal = entry(body.contact->normal, i);
    Lane along{}, square{};
    for (int k = 0; k < axes; ++k) {
      along += entry(normal, k) * mode(n, k);
      square += entry(normal, k) * entry(normal, k);
    }
    const Lane size = body.contact->support(Row<BoundaryNode>(i)),
               tangential = size * body.contact->tangential,
               more = (size * body.contact->along_normal - tangential) * along / square;
    for (int k = 0; k < axes; ++k)
      mode(n, axes + k) = -(tangential * mode(n, k) + more * entry(normal, k));
  }
}

// The same with the elements.
template <class F>
void elastic_forces(const ModeBody<F>& body, const ModeView<typename F::Dimension>& mode) {
  spring_forces(body, mode);
  for (int i = 0; i < body.shape.elements(); ++i) subtract_stiffness(body, Row<Element>(i), mode);
}

// With inerters between the nodes: what they add to v M v (mass over density), and to the forces, so that these over the
// nodal masses are the accelerations.
template <class F>
Lane add_inerters(const ModeBody<F>& body, const ModeView<typename F::Dimension>& mode) {
  using D = typename F::Dimension;
  Lane mass{};
  if (!body.inertance) return mass;
  const auto none = [](int, int) { return Lane{}; };  // turning is of second order
  for (const InerterChain& chain : body.shape.chains.all) {
    const auto acceleration = [&](int i, int k) -> Lane {
      const Row<Node> n = entry(chain.nodes, i);
      return (1 / body.shape.size_of_node(n.value)) * mode(n, D::axes + k);
    };
    const auto v = of_chain(chain, mode);
    mass += 2.0 *
            energy_of_inerters<D>(chain, *body.inertance, Lane(1.0), of_chain(chain, body.x), v, v);
    with_links(chain, [&](auto links) {
      const auto pull = forces_of_inerters<D, links>(chain, *body.inertance, Lane(1.0), Lane(1.0),
                                                     of_chain(chain, body.x), none, acceleration);
      for (int i = 0; i < nodes_of_chain(links); ++i)
        for (int k = 0; k < D::axes; ++k)
          mode(entry(chain.nodes, i), D::axes + k) += entry(entry(pull, i), k);
    });
  }
  return mass;
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
  mass += add_inerters(body, mode);
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

// m, largest ratio of drag to stiffness on the outline or surface: dashpots are in proportion to the square root of the stiffness
// times the mass behind.
inline double largest_drag(const Shape& shape) {
  double largest = 0;
  for (const Shape::Edge& edge : shape.edges) largest = std::max(largest, 1 / edge.stiffness);
  return largest;
}
inline double largest_drag(const space::Shape& shape) {
  double largest = 0;
  for (const space::Shape::Face& face : shape.faces)
    largest = std::max(largest, std::sqrt(face.thickness / face.stiffness));
  return largest;
}

// k K of the springs on the outline. A dashpot c lagging by half a step counts like a spring of 2 c/dt; `step` stands in for dt
// and must not be longer.
template <class AnyShape>
Lane contact_modulus(const ContactRules& rules, double stiffening, const AnyShape& shape,
                     const Lane& bulk, const Lane& rho, const Lane& step) {
  // With less damping than this, blocks are stable for stiffness 0.35 to 100 within the margin of the spring bound. With rings
  // of inerters, which come first, one of four elements needs more.
  constexpr double little_damping = 0.3;
  const bool rings = rules.inertance > 0 && !shape.chains.all.empty() &&
                     shape.chains.all.front().links == links_of_ring;
  const double of_dashpots = rings ? 4 : 2;
  if (rules.damping == 0 || (!rules.servos && rules.damping <= little_damping))
    return rules.stiffness * (stiffening + of_dashpots * rules.damping) * bulk;
  return rules.stiffness * stiffening * bulk + (2 * dashpot_ratio(rules) * largest_drag(shape)) *
                                                   sqrt(rules.stiffness * bulk * rho) / step;
}

// Without contact.
template <class F>
ModeBody<F> mode_body(const highest_mode<F>& of, Chunk chunk) {
  const Row<Particle> particle;
  ModeBody<F> body{of.bodies.shape_of(chunk),
                   of.position.chunk(chunk),
                   of.deviator.chunk(chunk),
                   of.material.elastic.bulk.chunk(chunk)(particle),
                   of.material.elastic.shear.chunk(chunk)(particle),
                   std::nullopt,
                   std::nullopt};
  if (of.estimate.inertance) body.inertance = of.estimate.inertance->chunk(chunk);
  return body;
}

// `step`: see contact_modulus.
template <class F>
void add_springs(const highest_mode<F>& of, Chunk chunk, const Lane& step, ModeBody<F>& body) {
  const ContactRules& rules = *of.springs->rules;
  const double of_chunk = springs_of(chunk, *of.bodies.bodies, rules, *of.clock);
  const Lane rho = of.material.density.chunk(chunk)(Row<Particle>());
  const Lane along = contact_modulus(rules, of_chunk, body.shape, body.bulk, rho, step);
  // Bonds are equally stiff in all directions.
  const Lane tangential = rules.initial_stiffness.empty()
                              ? min(along, rules.tangential * rules.stiffness * body.bulk)
                              : along;
  body.contact = typename ModeBody<F>::Contact{
      of.springs->support.chunk(chunk), boundary_normals(body.shape, body.x), along, tangential};
}

template <class F>
[[gnu::flatten]] void highest_mode<F>::operator()(Chunk chunk) const {
  if (clock->step < clock->next_look) return;
  const auto known = estimate.gain.chunk(chunk);
  const Row<Particle> particle;
  Lane& step = estimate.stable.chunk(chunk)(particle);
  const bool first = known(particle, 1)[0] == 0;
  if (!first && known(particle, 1)[0] < looks_between_iterations) {
    known(particle, 1) += 1.0;
    step *= known(particle, 0);
    return;
  }
  const Lane rho = material.density.chunk(chunk)(particle);
  ModeBody<F> body = mode_body(*this, chunk);
  const auto longer_than_bound = [&](const Lane& highest) {
    const Lane longest = mode_margin * stable_step(chunk, rho, highest, damping);
    // A quotient that is not positive says nothing.
    const Lane gain = select(highest > 0.0, longest / step, Lane(1.0));
    return Lane(max(1.0, min(gain, body.inertance ? longest_with_inerters : longest_gain)));
  };
  const auto quotient = [&](int iterations, const Lane& gain) {
    if (springs) add_springs(*this, chunk, step * gain, body);
    Lane highest{};
    for (int i = 0; i < iterations; ++i) highest = iterate(body, estimate.mode.chunk(chunk));
    return highest;
  };
  Lane& gain = known(particle, 0);
  // Dashpots are less stiff in longer steps: from the bound of the elements on, the estimates approach the stable step from below.
  const bool refined = body.inertance && springs && springs->rules->damping > 0;
  if (first) {
    gain = longer_than_bound(quotient(first_iterations, Lane(1.0)));
    for (int i = 0; i < (refined ? rounds_with_dashpots : 0); ++i)
      gain = longer_than_bound(quotient(iterations_of_round, gain));
  } else {
    gain = longer_than_bound(quotient(1, refined ? Lane(0.95 * gain) : Lane(1.0)));
  }
  known(particle, 1) = 1.0;
  step *= gain;
}

inline const auto& corners_of(const Shape& shape, Row<Element> e) { return entry(shape.quads, e); }
inline const auto& corners_of(const space::Shape& shape, Row<Element> e) {
  return entry(shape.hexahedra, e);
}

template <class F>
std::vector<Lane> highest_mode<F>::energies(Chunk chunk) const {
  constexpr int axes = D::axes;
  ModeBody<F> body = mode_body(*this, chunk);
  if (springs) add_springs(*this, chunk, estimate.stable.chunk(chunk)(Row<Particle>()), body);
  const auto nodes = static_cast<std::ptrdiff_t>(body.shape.nodes.size());
  const Lane* known = &std::as_const(estimate.mode.chunk(chunk)(Row<Node>(0)));
  std::vector<Lane> copy(known, known + nodes * HighestMode<D>::count);
  const ModeView<D> mode(copy.data());
  // Of the forces of that node, which are set to zero for the next element.
  const auto taken = [&](Row<Node> n) {
    Lane energy{};
    for (int k = 0; k < axes; ++k) energy -= mode(n, k) * std::exchange(mode(n, axes + k), Lane{});
    return energy;
  };
  std::vector<Lane> energies(static_cast<std::size_t>(body.shape.elements()) + 1);
  spring_forces(body, mode);
  for (int n = 0; n < nodes; ++n) energies.back() += taken(Row<Node>(n));
  for (int i = 0; i < body.shape.elements(); ++i) {
    subtract_stiffness(body, Row<Element>(i), mode);
    for (const Row<Node> n : corners_of(body.shape, Row<Element>(i)))
      entry(energies, i) += taken(n);
  }
  return energies;
}

}  // namespace pulvis
