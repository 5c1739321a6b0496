// kinetic_energy, plastic_work; elastic_energy, hourglass_energy of quads: per particle, on sampled steps.
//
// Kinetic energy is 1/2 m v_(n-1/2) . v_(n+1/2): together with the stored energy at t_n it is what the
// leapfrog conserves (Hairer, Lubich & Wanner 2006), so that the balance shows errors, not phase shifts.
#include <cmath>

#include "components/run_state.hpp"
#include "components/space/formulation.hpp"
#include "engine/access.hpp"
#include "engine/entry.hpp"
#include "systems/body/element_access.hpp"
#include "systems/body/hourglass_kernel.hpp"
#include "systems/body/inerter_chains.hpp"
#include "systems/body/nodal_force.hpp"
#include "systems/body/systems.hpp"

namespace pulvis {

template <class D>
void kinetic_energy<D>::operator()(Chunk chunk) const {
  const auto& shape = bodies.shape_of(chunk);
  const NodalForce<D> force(forces, shape, chunk);
  const auto v = velocity.chunk(chunk);
  const Lane mass_per_size = density.chunk(chunk)(Row<Particle>()) * bodies.depth();
  const double half = 0.5 * (clock->dt_before + clock->dt);
  Lane total{};
  const auto mass_of = [&](Row<Node> n) -> Lane {
    return mass_per_size * shape.size_of_node(n.value);
  };
  const auto add = [&](Row<Node> n, int k, const Lane& f) {
    total += 0.5 * v(n, k) * (mass_of(n) * v(n, k) + f * half);
  };
  const auto add_freely = [&](Row<Node> n) {
    for (int k = 0; k < D::axes; ++k) add(n, k, force(n, k));
  };
  if (inerters) {
    const auto x = inerters->position.chunk(chunk);
    const auto c = inerters->inertance.chunk(chunk);
    const Lane size_per_mass = 1 / mass_per_size;
    const auto add_chain = [&]<int links>(const InerterChain& chain,
                                          std::integral_constant<int, links>) {
      const auto acceleration = [&](int i, int k) -> Lane {
        const Row<Node> n = entry(chain.nodes, i);
        return force(n, k) / mass_of(n);
      };
      const auto pull =
          forces_of_inerters<D, links>(chain, c, mass_per_size, size_per_mass, of_chain(chain, x),
                                       of_chain(chain, v), acceleration);
      const auto of_node = [&](int i, int k) -> Lane {
        return force(entry(chain.nodes, i), k) + entry(entry(pull, i), k);
      };
      const auto after = [&](int i, int k) -> Lane {
        const Row<Node> n = entry(chain.nodes, i);
        return v(n, k) + of_node(i, k) / mass_of(n) * half;
      };
      for (int i = 0; i < nodes_of_chain(links); ++i)
        for (int k = 0; k < D::axes; ++k) add(entry(chain.nodes, i), k, of_node(i, k));
      total += energy_of_inerters<D>(chain, c, mass_per_size, of_chain(chain, x),
                                     of_chain(chain, v), after);
    };
    for (const InerterChain& chain : shape.chains.all)
      with_links(chain, [&](auto links) { add_chain(chain, links); });
    for (const Row<Node> n : shape.chains.single) add_freely(n);
  } else {
    for (int i = 0; i < static_cast<int>(shape.nodes.size()); ++i) add_freely(Row<Node>(i));
  }
  energy.chunk(chunk)(Row<Particle>()) = total;
}
template struct kinetic_energy<TwoD>;
template struct kinetic_energy<ThreeD>;

template <class F>
[[gnu::flatten]] void elastic_energy<F>::operator()(Chunk chunk) const {
  const Row<Particle> particle;
  const Shape& shape = bodies->shape_of_chunk(chunk);
  const auto nodes = position.chunk(chunk);
  const Lane shear = elastic.shear.chunk(chunk)(particle), k = elastic.bulk.chunk(chunk)(particle);
  Lane total{};
  const auto add_volumetric = [&](double area, Lane theta) {
    for (int l = 0; l < lane_count; ++l)
      total[l] += area * kernels::volumetric_energy(k[l], theta[l]);
  };
  for (int i = 0; i < shape.elements(); ++i) {
    const Row<Element> e(i);
    const auto map = quad_map<F::points>(nodes, entry(shape.quads, i));
    const auto& points = points_of<F::points>(shape, i);
    double area = 0;
    for (int g = 0; g < F::points; ++g) {
      const auto& point = entry(points, g);
      const auto f =
          kernels::deformation_gradient(map_gradient<F::points>(map, g), point.inverse_jacobian);
      const auto c =
          cp_inverse ? cp_inverse_at(cp_inverse->chunk(chunk), e, g) : kernels::Symmetric3<Lane>{};
      total += point.determinant * kernels::isochoric_energy(f, c, shear);
      if constexpr (F::volumes == F::points) add_volumetric(point.determinant, determinant(f));
      area += point.determinant;
    }
    if constexpr (F::volumes < F::points) add_volumetric(area, mean_dilatation(map, points));
  }
  energy.chunk(chunk)(particle) = total * bodies->thickness;
}
template struct elastic_energy<FourPoint>;
template struct elastic_energy<Standard>;
template struct elastic_energy<OnePoint>;

template <class F>
void plastic_work<F>::operator()(Chunk chunk) const {
  const Row<Particle> particle;
  const auto& shape = bodies.shape_of(chunk);
  const auto strain = eps.chunk(chunk);
  Lane total{};
  const auto add = [&](const auto& law) {
    for (int i = 0; i < shape.elements(); ++i)
      for (int g = 0; g < F::points; ++g)
        total += shape.template size_of_point<F::points>(i, g) *
                 law.plastic_work(strain(Row<Element>(i), g));
  };
  // Elastic particles in a chunk with plastic ones have an infinite yield stress and no strain: 0, not NaN.
  const Lane yield = min(flow.yield_stress.chunk(chunk)(particle), 1e300);
  const kernels::LinearHardening<Lane> linear{yield, flow.hardening.chunk(chunk)(particle)};
  if (flow.laws)
    with_hardening((*flow.laws)->of_chunk(*bodies.bodies, chunk), linear, add);
  else
    add(linear);
  total *= bodies.depth();
  total += beyond.chunk(chunk)(particle);
  // Joint plastic flow dissipates both; the hourglass part is reported separately.
  if (hourglass) total -= hourglass->chunk(chunk)(particle);
  work.chunk(chunk)(particle) = total;
}
template struct plastic_work<FourPoint>;
template struct plastic_work<Standard>;
template struct plastic_work<OnePoint>;
template struct plastic_work<space::OnePoint>;
template struct plastic_work<space::EightPoint>;

void hourglass_energy::operator()(Chunk chunk) const {
  const Row<Particle> particle;
  const Shape& shape = bodies->shape_of_chunk(chunk);
  const Lane shear = elastic.shear.chunk(chunk)(particle);
  const Lane modulus = kernels::plane_strain_modulus(shear, elastic.bulk.chunk(chunk)(particle));
  const auto m = stress.chunk(chunk);
  const auto nodes = position.chunk(chunk);
  Lane total{};
  for (int i = 0; i < shape.elements(); ++i) {
    const Row<Element> e(i);
    const auto map = quad_map<1>(nodes, entry(shape.quads, e));
    const auto w = kernels::natural_hourglass(map, 1.0 / determinant(map_gradient<1>(map, 0)));
    total += entry(shape.centre, e)[0].determinant *
             (kernels::hourglass_energy<Lane>({m(e, 0), m(e, 1)}, modulus) +
              kernels::inversion_barrier_energy(
                  kernels::corner_ratios(w, entry(shape.hourglass, e)), shear));
  }
  total *= bodies->thickness;
  if (spent) total += spent->chunk(chunk)(particle);
  energy.chunk(chunk)(particle) = total;
}

}  // namespace pulvis
