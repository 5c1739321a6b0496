// particle_stress: mean Cauchy stress, area and centre of every particle.
//
// Law      area * stress = -sum over the nodes of internal force times position / thickness (virial): each
//          point is weighted with the area on which internal_force lets its stress act. Bending of
//          one-point elements adds nothing, since its energy does not change under uniform strain
// Runs     on sampled steps, once the stresses are known
// Active   when the scene requests particle stresses or contacts
#include "engine/entry.hpp"
#include "systems/body/element_access.hpp"
#include "systems/body/systems.hpp"

namespace pulvis {
namespace {

struct Sums {
  Lane xx{}, yy{}, xy{}, mean{}, area{}, x{}, y{};
};

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
                 Sums& sums) {
  const Quad& quad = entry(shape.quads, i);
  const auto map = quad_map<F::points>(x, quad);
  const auto& points = points_of<F::points>(shape, i);
  const Row<Element> e(i);
  Lane area{};
  for (std::size_t g = 0; g < static_cast<std::size_t>(F::points); ++g) {
    const Lane part = area_of_point<F>(map, points, g);
    const auto d = deviator(s, e, static_cast<int>(g));
    sums.xx = fma(part, d.xx, sums.xx);
    sums.yy = fma(part, d.yy, sums.yy);
    sums.xy = fma(part, d.xy, sums.xy);
    sums.mean = fma(part, p(e, F::volumes == 4 ? static_cast<int>(g) : 0), sums.mean);
    area += part;
  }
  const auto middle = [&](int k) {
    return 0.25 * ((x(quad[0], k) + x(quad[1], k)) + (x(quad[2], k) + x(quad[3], k)));
  };
  sums.x = fma(area, middle(0), sums.x);
  sums.y = fma(area, middle(1), sums.y);
  sums.area += area;
}

}  // namespace

template <class F>
void particle_stress<F>::operator()(Chunk chunk) const {
  const Row<Particle> particle;
  const Shape& shape = bodies->shape_of_chunk(chunk);
  Sums sums;
  for (int i = 0; i < shape.elements(); ++i)
    add_element<F>(shape, i, position.chunk(chunk), element.deviator.chunk(chunk),
                   element.mean.chunk(chunk), sums);
  const auto mean = stress.chunk(chunk);
  mean(particle, 0) = (sums.xx + sums.mean) / sums.area;
  mean(particle, 1) = (sums.yy + sums.mean) / sums.area;
  mean(particle, 2) = (sums.mean - (sums.xx + sums.yy)) / sums.area;
  mean(particle, 3) = sums.xy / sums.area;
  area.chunk(chunk)(particle) = sums.area;
  centre.chunk(chunk)(particle, 0) = sums.x / sums.area;
  centre.chunk(chunk)(particle, 1) = sums.y / sums.area;
}
template struct particle_stress<FourPoint>;
template struct particle_stress<Standard>;
template struct particle_stress<OnePoint>;

}  // namespace pulvis
