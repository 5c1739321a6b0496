// particle_stress: mean Cauchy stress, deformed volume and centre of every particle.
//
// Law      volume * stress = -sum over the nodes of internal force times position (virial): every point is weighted by
//          the volume on which its stress acts. Hourglass stress of one-point elements adds nothing: its energy does
//          not change with uniform strain
// Runs     in sampled steps, once the stresses are known
// Active   if the scene asks for particle stresses or contacts
#include "systems/body/particle_stress.hpp"
#include "engine/entry.hpp"
#include "systems/space/body/element_access.hpp"
#include "systems/space/body/systems.hpp"

namespace pulvis::space {
namespace {

void add_deviator(const kernels::Deviator<Lane>& s, const Lane& volume, StressSums<ThreeD>& sums) {
  const std::array parts{s.xx, s.yy, s.xy, s.yz, s.zx};
  for (std::size_t k = 0; k < parts.size(); ++k)
    sums.deviator[k] = fma(volume, parts[k], sums.deviator[k]);
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
                 StressSums<ThreeD>& sums) {
  const Hexahedron& nodes = entry(shape.hexahedra, i);
  const Row<Element> e(i);
  const double undeformed = entry(shape.element, i).volume;
  const Lane theta = dilatation<F>(shape, i, element_modes(x, nodes)), volume = theta * undeformed;
  for (int g = 0; g < F::points; ++g)
    add_deviator(deviator_at(s, e, g), theta * shape.size_of_point<F::points>(i, g), sums);
  const auto middle = [&](int k) {
    Lane sum{};
    for (const Row<Node> node : nodes) sum += x(node, k);
    return 0.125 * sum;
  };
  sums.mean = fma(volume, p(e), sums.mean);
  for (int k = 0; k < 3; ++k) entry(sums.middle, k) = fma(volume, middle(k), entry(sums.middle, k));
  sums.size += volume;
}

}  // namespace

template <class F>
void particle_stress<F>::operator()(Chunk chunk) const {
  const Shape& shape = bodies.shape_of(chunk);
  StressSums<ThreeD> sums;
  for (int i = 0; i < shape.elements(); ++i)
    add_element<F>(shape, i, position.chunk(chunk), element.deviator.chunk(chunk),
                   element.mean.chunk(chunk), sums);
  sums.store_means(*this, chunk);
}
template struct particle_stress<OnePoint>;
template struct particle_stress<EightPoint>;

}  // namespace pulvis::space
