// particle_stress: mean Cauchy stress, deformed volume and centre of every particle.
//
// Law      volume * stress = -sum over the nodes of internal force times position (virial): every point is weighted by
//          the volume on which its stress acts. Hourglass stress of one-point elements adds nothing: its energy does
//          not change with uniform strain
// Runs     in sampled steps, once the stresses are known
// Active   if the scene asks for particle stresses or contacts
#include "engine/entry.hpp"
#include "systems/space/body/element_access.hpp"
#include "systems/space/body/systems.hpp"

namespace pulvis::space {
namespace {

struct Sums {
  Lane xx{}, yy{}, xy{}, yz{}, zx{}, mean{}, volume{}, x{}, y{}, z{};
};

void add_deviator(const kernels::Deviator<Lane>& s, const Lane& volume, Sums& sums) {
  sums.xx = fma(volume, s.xx, sums.xx);
  sums.yy = fma(volume, s.yy, sums.yy);
  sums.xy = fma(volume, s.xy, sums.xy);
  sums.yz = fma(volume, s.yz, sums.yz);
  sums.zx = fma(volume, s.zx, sums.zx);
}

// Ratio of current to undeformed volume.
template <class F>
Lane dilatation(const Shape& shape, int i, const kernels::ElementModes<Lane>& modes) {
  const auto det = [](const kernels::Matrix3<Lane>& f) {
    return kernels::determinant(f, kernels::adjugate(f));
  };
  if constexpr (F::points == 1)
    return det(kernels::deformation_gradient(modes, entry(shape.element, i).gradient));
  Lane now{};
  for (int g = 0; g < F::points; ++g) {
    const Shape::GaussPoint& point = entry(entry(shape.gauss, i), g);
    now += point.volume * det(kernels::point_gradient(modes, point.inverse_jacobian,
                                                      kernels::gauss_coordinates(g)));
  }
  return now * (1 / entry(shape.element, i).volume);
}

template <class F, class Nodes, class Deviators, class Means>
void add_element(const Shape& shape, int i, const Nodes& x, const Deviators& s, const Means& p,
                 Sums& sums) {
  const Hexahedron& nodes = entry(shape.hexahedra, i);
  const Row<Element> e(i);
  const double undeformed = entry(shape.element, i).volume;
  const Lane theta = dilatation<F>(shape, i, element_modes(x, nodes)), volume = theta * undeformed;
  for (int g = 0; g < F::points; ++g) {
    const double share = F::points == 1 ? undeformed : entry(entry(shape.gauss, i), g).volume;
    add_deviator(deviator_at(s, e, g), theta * share, sums);
  }
  const auto middle = [&](int k) {
    Lane sum{};
    for (const Row<Node> node : nodes) sum += x(node, k);
    return 0.125 * sum;
  };
  sums.mean = fma(volume, p(e), sums.mean);
  sums.x = fma(volume, middle(0), sums.x);
  sums.y = fma(volume, middle(1), sums.y);
  sums.z = fma(volume, middle(2), sums.z);
  sums.volume += volume;
}

}  // namespace

template <class F>
void particle_stress<F>::operator()(Chunk chunk) const {
  const Row<Particle> particle;
  const Shape& shape = bodies.shape_of(chunk);
  Sums sums;
  for (int i = 0; i < shape.elements(); ++i)
    add_element<F>(shape, i, position.chunk(chunk), element.deviator.chunk(chunk),
                   element.mean.chunk(chunk), sums);
  const Lane over = 1.0 / sums.volume;
  const auto mean = stress.chunk(chunk);
  mean(particle, 0) = (sums.xx + sums.mean) * over;
  mean(particle, 1) = (sums.yy + sums.mean) * over;
  mean(particle, 2) = (sums.mean - (sums.xx + sums.yy)) * over;
  mean(particle, 3) = sums.xy * over;
  mean(particle, 4) = sums.yz * over;
  mean(particle, 5) = sums.zx * over;
  volume.chunk(chunk)(particle) = sums.volume;
  centre.chunk(chunk)(particle, 0) = sums.x * over;
  centre.chunk(chunk)(particle, 1) = sums.y * over;
  centre.chunk(chunk)(particle, 2) = sums.z * over;
}
template struct particle_stress<OnePoint>;
template struct particle_stress<EightPoint>;

}  // namespace pulvis::space
