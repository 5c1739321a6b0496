// elastic_energy, hourglass_energy of hexahedra: per particle, in sampled steps. (Kinetic energy and plastic work, in both
// dimensions: systems/body/energies.cpp)
#include "components/run_state.hpp"
#include "engine/access.hpp"
#include "engine/entry.hpp"
#include "systems/space/body/element_access.hpp"
#include "systems/space/body/inversion_barrier_kernel.hpp"
#include "systems/space/body/systems.hpp"

namespace pulvis::space {
namespace {

// The deformation gradient at point g of an element.
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
      const auto c = cp_inverse ? cp_inverse_at(cp_inverse->chunk(chunk), Row<Element>(i), g)
                                : kernels::Symmetric3<Lane>{};
      const double volume = shape.size_of_point<F::points>(i, g);
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
