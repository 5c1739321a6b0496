// trial_stress: Cauchy stress at every Gauss point as if no plastic flow happened in this step.
// elastic_stress: the same for scenes without plasticity, where it is the stress.
//
// Source   systems/element_kernel.hpp, systems/j2_kernel.hpp
// Runs     after integrate of the step before; before j2_return_map and internal_force
// Watches  least det F of every particle, for the health system
#include "systems/element_access.hpp"
#include "systems/systems.hpp"

namespace pulvis {
namespace {

struct Views {
  ChunkView<Position, const Lane*> x;
  ChunkView<DeviatoricStress, Lane*> s;
  ChunkView<MeanStress, Lane*> p;
  Lane mu, bulk;
};

// `left(F, r2, e, g)` gives F C_p^-1 F^T, with r2 = J^(-2/3). Returns the least det F of the element's Gauss points.
template <class LeftCauchyGreen>
Lane element_stress(const Views& v, const Shape& shape, Row<Element> e,
                    const LeftCauchyGreen& left) {
  const auto at = static_cast<std::size_t>(e.value);
  const auto map = quad_map(v.x, shape.quads[at]);
  const ElementGauss& gauss = shape.gauss[at];
  const Lane theta = dilatation(map, gauss);
  const Lane over_theta = 1.0 / theta;
  v.p(e) = 0.5 * v.bulk * (theta - over_theta);
  Lane least = theta;
  for (int g = 0; g < gauss_points; ++g) {
    const auto f = kernels::deformation_gradient(
        map_gradient(map, g), gauss[static_cast<std::size_t>(g)].inverse_jacobian);
    const Lane j = determinant(f);
    const Lane r = kernels::inverse_cube_root(j);
    const Lane r2 = r * r;
    store(v.s, e, g, kernels::scaled_deviator(left(f, r2, e, g), v.mu * over_theta * r2));
    least = least < j ? least : j;
  }
  return least;
}

// A NaN wins every comparison and is not replaced by a later number, so that it is seen.
void keep_worst(Lane least, Row<Element> e, Lane& worst, Lane& worst_element) {
  const LaneMask lower = ~(least >= worst) & (worst == worst);
  worst_element = lower ? broadcast(e.value) : worst_element;
  worst = lower ? least : worst;
}

template <class LeftCauchyGreen>
void chunk_stress(Chunk chunk, const Bodies& bodies, const Views& v,
                  Write<LeastJacobian> least_jacobian, Write<WorstElement> worst_element,
                  const LeftCauchyGreen& left) {
  const Shape& shape = bodies.shape_of_chunk(chunk);
  Lane worst = broadcast(1e300), which{};
  for (int i = 0; i < shape.elements(); ++i)
    keep_worst(element_stress(v, shape, Row<Element>(i), left), Row<Element>(i), worst, which);
  least_jacobian.chunk(chunk)(Row<Particle>()) = worst;
  worst_element.chunk(chunk)(Row<Particle>()) = which;
}

}  // namespace

[[gnu::flatten]] void trial_stress(Chunk chunk, Read<Bodies> bodies, Read<Position> x,
                                   Read<ShearModulus> mu, Read<BulkModulus> bulk,
                                   Read<PlasticMetric> metric, Write<IsochoricScale> isochoric,
                                   Write<DeviatoricStress> s, Write<MeanStress> p,
                                   Write<LeastJacobian> least, Write<WorstElement> worst) {
  const Row<Particle> particle;
  const auto c = metric.chunk(chunk);
  const auto scale = isochoric.chunk(chunk);
  chunk_stress(chunk, *bodies,
               {x.chunk(chunk), s.chunk(chunk), p.chunk(chunk), mu.chunk(chunk)(particle),
                bulk.chunk(chunk)(particle)},
               least, worst, [&](const kernels::Matrix2<Lane>& f, Lane r2, Row<Element> e, int g) {
                 scale(e, g) = r2;
                 return kernels::left_cauchy_green(f, plastic_metric(c, e, g));
               });
}

[[gnu::flatten]] void elastic_stress(Chunk chunk, Read<Bodies> bodies, Read<Position> x,
                                     Read<ShearModulus> mu, Read<BulkModulus> bulk,
                                     Write<DeviatoricStress> s, Write<MeanStress> p,
                                     Write<LeastJacobian> least, Write<WorstElement> worst) {
  const Row<Particle> particle;
  chunk_stress(chunk, *bodies,
               {x.chunk(chunk), s.chunk(chunk), p.chunk(chunk), mu.chunk(chunk)(particle),
                bulk.chunk(chunk)(particle)},
               least, worst, [](const kernels::Matrix2<Lane>& f, Lane, Row<Element>, int) {
                 return kernels::left_cauchy_green(f);
               });
}

}  // namespace pulvis
