// highest_mode: stable time step of each particle as a whole, in place of that of its worst element.
//
// Source   Power iteration on M^-1 K (Rayleigh quotient), as in the global estimator of Abaqus/Explicit.
//          K of highest_mode_kernel.hpp at the current positions, with every edge of the outline in
//          contact: no part of it is softer than what the step integrates, so that contacts may come and go
//          between two evaluations. The quotient converges from below, hence a margin. The stored value is
//          the ratio to the element bound, which itself follows the geometry at every evaluation; the mode
//          changes slowly, one iteration every fourth evaluation tracks it
// Runs     after stable_time_step, when that is evaluated
// Active   when the scene sets time.estimate = "highest-mode"
#include <limits>

#include "engine/entry.hpp"
#include "systems/body/element_bound.hpp"
#include "systems/body/highest_mode_kernel.hpp"
#include "systems/body/systems.hpp"

namespace pulvis {
namespace {

constexpr int first_iterations = 300;
constexpr double looks_between_iterations = 4;
constexpr double margin = 0.98;  // 300 iterations leave an error of half a percent
constexpr double longest_gain = 1.3;  // over the element bound; undeformed discs reach 1.2

template <int Points>
struct Body {
  const Shape& shape;
  ChunkView<Position<TwoD>, const Lane*> x;
  ChunkView<DeviatoricStress<TwoD, Points>, const Lane*> stress;
  const ChunkView<ContactSupport, const Lane*>* support;  // null: no contact possible
  Lane bulk, shear, contact;                              // Pa
};

// -K v into components 2 and 3; for unit slice depth.
template <int Points>
void elastic_forces(const Body<Points>& body, const ChunkView<HighestMode, Lane*>& mode) {
  const Shape& shape = body.shape;
  for (int i = 0; i < static_cast<int>(shape.nodes.size()); ++i) {
    const Row<Node> n(i);
    const Lane spring = body.support && i < shape.boundary_nodes
                            ? body.contact * (*body.support)(Row<BoundaryNode>(i))
                            : Lane{};
    for (int k = 0; k < 2; ++k) mode(n, 2 + k) = -(spring * mode(n, k));
  }
  const Lane inv_shear = 1.0 / body.shear;
  for (int i = 0; i < shape.elements(); ++i) {
    const Row<Element> e(i);
    const Quad& q = entry(shape.quads, e);
    const auto map = quad_map<4>(body.x, q);
    const double area = entry(shape.centre, e)[0].determinant;
    const Lane theta = determinant(map_gradient<1>(map, 0)) * (4 / area);
    const Lane distortion = theta * inv_shear * largest_norm<Points>(body.stress, e);
    const auto flux =
        kernels::tangent_flux(map, quad_map<4>(mode, q),
                              kernels::tangent_moduli(body.bulk, body.shear, theta, distortion),
                              Lane(area), corner_factor(map));
    const auto out = kernels::node_forces(flux, 0.25);
    for (std::size_t k = 0; k < 4; ++k) {
      mode(q[k], 2) += out.x[k];
      mode(q[k], 3) += out.y[k];
    }
  }
}

// One iteration; returns rho omega^2 of the current mode, Pa/m^2.
template <int Points>
Lane iterate(const Body<Points>& body, const ChunkView<HighestMode, Lane*>& mode) {
  elastic_forces(body, mode);
  const auto nodes = static_cast<int>(body.shape.nodes.size());
  const auto area = [&](int i) { return entry(body.shape.nodal_area, i); };
  Lane energy{}, mass{};
  for (int i = 0; i < nodes; ++i)
    for (int k = 0; k < 2; ++k) {
      const Lane v = mode(Row<Node>(i), k);
      energy -= v * mode(Row<Node>(i), 2 + k);
      mass += area(i) * (v * v);
    }
  const Lane quotient = energy / mass;
  // Shifted by somewhat less than half of the spectrum, which extends from zero to the quotient: the
  // other modes decay twice as fast.
  const Lane shift = 0.45 * quotient, scale = 1.0 / (quotient * sqrt(mass));
  for (int i = 0; i < nodes; ++i)
    for (int k = 0; k < 2; ++k) {
      Lane& v = mode(Row<Node>(i), k);
      v = -(scale * (mode(Row<Node>(i), 2 + k) * (1 / area(i)) + shift * v));
    }
  return quotient;
}

// With less damping than this, blocks are stable for stiffness 0.35 to 100 within the margin of the spring bound.
constexpr double little_damping = 0.3;

// k K of the springs on the outline. A dashpot c lagging by half a step counts like a spring of 2 c/dt; no step
// is shorter than the element bound, which stands in for dt.
Lane contact_modulus(const ContactRules& rules, double stiffening, const Shape& shape,
                     const Lane& bulk, const Lane& rho, const Lane& step) {
  if (rules.damping == 0 || (!rules.servos && rules.damping <= little_damping))
    return rules.stiffness * (stiffening + 2 * rules.damping) * bulk;
  double softest = std::numeric_limits<double>::infinity();
  for (const Shape::Edge& edge : shape.edges) softest = std::min(softest, edge.stiffness);
  return rules.stiffness * stiffening * bulk +
         (2 * dashpot_ratio(rules) / softest) * sqrt(rules.stiffness * bulk * rho) / step;
}

}  // namespace

template <int Points>
[[gnu::flatten]] void highest_mode<Points>::operator()(Chunk chunk) const {
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
  const Shape& shape = bodies->shape_of_chunk(chunk);
  const Lane contact =
      springs
          ? contact_modulus(*springs->rules, springs_of(chunk, *bodies, *springs->rules, *clock),
                            shape, k, rho, step)
          : Lane{};
  Body<Points> body{shape,
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
  const Lane longest = margin * stable_step(chunk, rho, highest, damping);
  known(particle, 0) = max(1.0, min(longest / step, longest_gain));
  known(particle, 1) = 1.0;
  step *= known(particle, 0);
}

template struct highest_mode<1>;
template struct highest_mode<4>;

}  // namespace pulvis
