// particle_stress: mean Cauchy stress, area and centre of every particle.
//
// Law      area * stress = -sum over the nodes of internal force times position / thickness (virial): each
//          point is weighted with the area on which internal_force lets its stress act. Bending of
//          one-point elements adds nothing, since its energy does not change under uniform strain
// Runs     on sampled steps, once the stresses are known
// Active   when the scene requests particle stresses or contacts
#include "systems/body/particle_stress.hpp"
#include "engine/entry.hpp"
#include "systems/body/element_access.hpp"

namespace pulvis {
namespace {

// The current weights of a point of the element: for the deviator, and for the mean stress.
template <class F, class Map>
Lane area_of_point(const Map& map, const ElementPoints<F::points>& points, std::size_t g) {
  if constexpr (F::volumes == 4)
    return determinant(map_gradient<4>(map, static_cast<int>(g)));
  else
    return mean_dilatation(map, points) * points[g].determinant;
}

template <class F, class Nodes, class Deviators, class Means>
void add_element(const Shape& shape, int i, const Nodes& x, const Deviators& s, const Means& p,
                 StressSums<TwoD>& sums) {
  const Quad& quad = entry(shape.quads, i);
  const auto map = quad_map<F::points>(x, quad);
  const auto& points = points_of<F::points>(shape, i);
  const Row<Element> e(i);
  Lane area{};
  for (std::size_t g = 0; g < static_cast<std::size_t>(F::points); ++g) {
    const Lane part = area_of_point<F>(map, points, g);
    const auto d = deviator(s, e, static_cast<int>(g));
    sums.deviator[0] = fma(part, d.xx, sums.deviator[0]);
    sums.deviator[1] = fma(part, d.yy, sums.deviator[1]);
    sums.deviator[2] = fma(part, d.xy, sums.deviator[2]);
    sums.mean = fma(part, p(e, F::volumes == 4 ? static_cast<int>(g) : 0), sums.mean);
    area += part;
  }
  const auto middle = [&](int k) {
    return 0.25 * ((x(quad[0], k) + x(quad[1], k)) + (x(quad[2], k) + x(quad[3], k)));
  };
  for (int k = 0; k < 2; ++k) entry(sums.middle, k) = fma(area, middle(k), entry(sums.middle, k));
  sums.size += area;
}

}  // namespace

template <class F>
void particle_stress<F>::operator()(Chunk chunk) const {
  const Shape& shape = bodies->shape_of_chunk(chunk);
  StressSums<TwoD> sums;
  for (int i = 0; i < shape.elements(); ++i)
    add_element<F>(shape, i, position.chunk(chunk), element.deviator.chunk(chunk),
                   element.mean.chunk(chunk), sums);
  sums.store_means(*this, chunk);
}
template struct particle_stress<FourPoint>;
template struct particle_stress<Standard>;
template struct particle_stress<OnePoint>;

}  // namespace pulvis
