// elastic_force: Cauchy stress at every integration point, and the nodal forces from the stresses, in scenes
// without plasticity.
//
// Source   systems/space/body/element_kernel.hpp, j2_kernel.hpp; one-point elements: hourglass_kernel.hpp. Forces are
//          the exact derivative of the element's stored energy
// Runs     after integrate of the previous step
// Watches  minimum det F of every particle, for element_health
#include "systems/space/body/element_force.hpp"

namespace pulvis::space {
namespace {

struct ElasticMaterial {
  kernels::Symmetric3<Packet> left(const kernels::Matrix3<Packet>& f, Row<Element>, int) const {
    return kernels::square(f);
  }
  void remove_plastic(Row<Element>, kernels::Hourglass<Packet>&) const {}
  void flow(const PointAt&, kernels::Deviator<Packet>&) const {}
  void flow(const PointAt&, kernels::Deviator<Packet>&, kernels::Hourglass<Packet>&,
            const kernels::Hourglass<Packet>&) const {}
};

}  // namespace

template <class F>
[[gnu::flatten]] void elastic_force<F>::operator()(BusyChunk chunk) const {
  const Shape& shape = bodies.shape_of(chunk);
  ElasticMaterial material;
  for (int part = 0; part < parts_of_a_lane; ++part)
    part_force(chunk, part, shape, force_views<F>(position, elastic, results, chunk, part),
               results.worst, material);
}
template struct elastic_force<OnePoint>;
template struct elastic_force<EightPoint>;

}  // namespace pulvis::space
