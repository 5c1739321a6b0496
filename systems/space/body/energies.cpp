// kinetic_energy, elastic_energy, plastic_work, hourglass_energy: per particle, in sampled steps.
//
// Kinetic energy is 1/2 m v_(n-1/2) . v_(n+1/2): together with the stored energy at t_n this is what the
// leapfrog conserves (Hairer, Lubich & Wanner 2006), so that the balance shows errors, not phase.
#include "components/run_state.hpp"
#include "engine/access.hpp"
#include "engine/entry.hpp"
#include "systems/space/body/element_access.hpp"
#include "systems/space/body/inversion_barrier_kernel.hpp"
#include "systems/space/body/systems.hpp"

namespace pulvis::space {
namespace {

// For point g of an element: its volume, and the deformation gradient there.
template <class F>
double point_volume(const Shape& shape, int element, int g) {
  if constexpr (F::points == 1)
    return entry(shape.element, element).volume;
  else
    return entry(entry(shape.gauss, element), g).volume;
}
template <class F>
kernels::Matrix3<Lane> gradient_at(const Shape& shape, int element, int g,
                                   const kernels::ElementModes<Lane>& modes) {
  if constexpr (F::points == 1)
    return kernels::deformation_gradient(modes, entry(shape.element, element).gradient);
  else
    return kernels::point_gradient(modes, entry(entry(shape.gauss, element), g).inverse_jacobian,
                                   kernels::gauss_coordinates(g));
}

Lane volumetric_energies(Lane bulk, Lane theta) {
  return Lane::from([&](int l) { return pulvis::kernels::volumetric_energy(bulk[l], theta[l]); });
}

}  // namespace

void kinetic_energy::operator()(Chunk chunk) const {
  const Shape& shape = bodies.shape_of(chunk);
  const auto f = forces.internal.chunk(chunk);
  const auto v = velocity.chunk(chunk);
  const Lane rho = density.chunk(chunk)(Row<Particle>());
  const double half = 0.5 * (clock->dt_before + clock->dt);
  Lane total{};
  for (int i = 0; i < static_cast<int>(shape.nodes.size()); ++i) {
    const Row<Node> n(i);
    const Lane mass = rho * entry(shape.nodal_volume, i);
    for (int k = 0; k < 3; ++k) {
      Lane force = f(n, k);
      if (forces.contact && i < shape.surface_nodes)
        force += forces.contact->chunk(chunk)(Row<BoundaryNode>(i), k);
      total += 0.5 * v(n, k) * (mass * v(n, k) + force * half);
    }
  }
  energy.chunk(chunk)(Row<Particle>()) = total;
}

template <class F>
[[gnu::flatten]] void elastic_energy<F>::operator()(Chunk chunk) const {
  const Row<Particle> particle;
  const Shape& shape = bodies.shape_of(chunk);
  const auto nodes = position.chunk(chunk);
  const Lane shear = elastic.shear.chunk(chunk)(particle), k = elastic.bulk.chunk(chunk)(particle);
  Lane total{};
  for (int i = 0; i < shape.elements(); ++i) {
    const auto modes = element_modes(nodes, entry(shape.hexahedra, i));
    Lane now{};
    for (int g = 0; g < F::points; ++g) {
      const auto f = gradient_at<F>(shape, i, g, modes);
      const Lane j = kernels::determinant(f, kernels::adjugate(f));
      const Lane r = kernels::inverse_cube_root(j);
      const auto c = metric ? metric_at(metric->chunk(chunk), Row<Element>(i), g)
                            : kernels::Symmetric3<Lane>{};
      const double volume = point_volume<F>(shape, i, g);
      total += volume * kernels::isochoric_energy(f, c, shear, r * r);
      now += volume * j;
    }
    const double volume = entry(shape.element, i).volume;
    total += volume * volumetric_energies(k, now * (1 / volume));
  }
  energy.chunk(chunk)(particle) = total;
}
template struct elastic_energy<OnePoint>;
template struct elastic_energy<EightPoint>;

template <class F>
void plastic_work<F>::operator()(Chunk chunk) const {
  const Row<Particle> particle;
  const Shape& shape = bodies.shape_of(chunk);
  const auto strain = eps.chunk(chunk);
  Lane total{};
  const auto add = [&](const auto& law) {
    for (int i = 0; i < shape.elements(); ++i)
      for (int g = 0; g < F::points; ++g)
        total += point_volume<F>(shape, i, g) * law.plastic_work(strain(Row<Element>(i), g));
  };
  // Elastic particles in a chunk with plastic ones have infinite yield stress and zero strain: 0, not NaN.
  const Lane yield = min(flow.yield_stress.chunk(chunk)(particle), 1e300);
  const pulvis::kernels::LinearHardening<Lane> linear{yield, flow.hardening.chunk(chunk)(particle)};
  if (flow.laws)
    with_hardening((*flow.laws)->of_chunk(*bodies.bodies, chunk), linear, add);
  else
    add(linear);
  total += beyond.chunk(chunk)(particle);
  // The coupled flow of stress and hourglass stress dissipates both; the latter is reported separately.
  if (hourglass) total -= hourglass->chunk(chunk)(particle);
  work.chunk(chunk)(particle) = total;
}
template struct plastic_work<OnePoint>;
template struct plastic_work<EightPoint>;

[[gnu::flatten]] void hourglass_energy::operator()(Chunk chunk) const {
  const Row<Particle> particle;
  const Shape& shape = bodies.shape_of(chunk);
  const auto nodes = position.chunk(chunk);
  const Lane mu = elastic.shear.chunk(chunk)(particle);
  const auto moduli = kernels::hourglass_moduli(mu, elastic.bulk.chunk(chunk)(particle));
  Lane total{};
  for (int i = 0; i < shape.elements(); ++i) {
    const Row<Element> e(i);
    const Shape::Element& element = entry(shape.element, i);
    const auto modes = element_modes(nodes, entry(shape.hexahedra, i));
    const auto f = kernels::deformation_gradient(modes, element.gradient);
    const auto adj = kernels::adjugate(f);
    const Lane inv_j = Lane(1.0) / kernels::determinant(f, adj);
    const auto to = kernels::to_fibres(element.fibre, adj, inv_j);
    auto strain =
        kernels::hourglass_strain(kernels::hourglass_components(modes, to, element), element);
    if (plastic)
      strain = kernels::each_number(strain, hourglass_at(plastic->chunk(chunk), e),
                                    [](Lane a, Lane b) { return a - b; });
    total += (0.5 * element.volume) *
             kernels::hourglass_product(kernels::hourglass_stress(strain, moduli), strain);
    const auto determinants = kernels::gauss_determinants(modes, entry(shape.gauss, i));
    total += element.volume * kernels::inversion_barrier_energy(determinants, inv_j, mu);
  }
  if (spent) total += spent->chunk(chunk)(particle);
  energy.chunk(chunk)(particle) = total;
}

}  // namespace pulvis::space
