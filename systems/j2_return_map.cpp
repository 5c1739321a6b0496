// j2_return_map: brings trial stresses that left the von Mises yield surface back onto it; in elements
// with one point together with the stress of the hourglass modes.
//
// Source   systems/j2_kernel.hpp (Simo & Hughes 1998, box 9.1); systems/hourglass_kernel.hpp
// Runs     after trial_stress, before internal_force
// Active   when a material of the scene declares a yield stress
#include "systems/element_access.hpp"
#include "systems/hourglass_kernel.hpp"
#include "systems/systems.hpp"

namespace pulvis {
namespace {

// What shares the yield surface with the deviator of an element's points, and where its flow is kept.
struct NoBending {
  kernels::NothingBeside at(Row<Element>) const { return {}; }
  void keep(Row<Element>, const kernels::NothingBeside&, double) const {}
};

struct Bending {
  ChunkView<HourglassStress, Lane*> stress;
  ChunkView<PlasticHourglass, Lane*> plastic;
  Lane softness, over_modulus;
  Lane* work;  // J/m: of the chunk's particles in this step

  kernels::BendingBeside<Lane> at(Row<Element> e) const {
    return {{stress(e, 0), stress(e, 1)}, softness};
  }
  void keep(Row<Element> e, const kernels::BendingBeside<Lane>& returned, double area) const {
    const auto& m = returned.stress;
    const Lane one = over_modulus * (stress(e, 0) - m.one);
    const Lane two = over_modulus * (stress(e, 1) - m.two);
    *work = fma((1.0 / 3.0) * area, fma(m.one, one, m.two * two), *work);
    plastic(e, 0) += one;
    plastic(e, 1) += two;
    stress(e, 0) = m.one;
    stress(e, 1) = m.two;
  }
};

template <class F>
struct Views {
  ChunkView<Position, const Lane*> x;
  ChunkView<IsochoricScale<F::points>, const Lane*> scale;
  ChunkView<DeviatoricStress<F::points>, Lane*> stress;
  ChunkView<PlasticMetric<F::points>, Lane*> metric;
  ChunkView<PlasticStrain<F::points>, Lane*> strain;
  Lane mu, over_mu;
  kernels::LinearHardening<Lane> law;
};

template <class F, class Beside>
void return_point(const Views<F>& v, Row<Element> e, int g, const kernels::Matrix2<Lane>& f,
                  Lane mu_over_theta, Lane theta_over_mu, Beside& beside) {
  const auto next = kernels::radial_return<Lane>(
      {deviator(v.stress, e, g), plastic_metric(v.metric, e, g), v.strain(e, g)}, f, v.scale(e, g),
      mu_over_theta, theta_over_mu, v.law, beside);
  store(v.stress, e, g, next.s);
  v.metric(e, 4 * g) = next.c.xx;
  v.metric(e, 4 * g + 1) = next.c.yy;
  v.metric(e, 4 * g + 2) = next.c.zz;
  v.metric(e, 4 * g + 3) = next.c.xy;
  v.strain(e, g) = next.eps;
}

template <class F, class BendingViews>
void return_element(const Views<F>& v, const BendingViews& bending, const Shape& shape,
                    Row<Element> e) {
  auto beside = bending.at(e);
  LaneMask flows[F::points], some{};
  for (int g = 0; g < F::points; ++g) {
    flows[g] = kernels::yields(deviator(v.stress, e, g), v.strain(e, g), v.law, beside);
    some |= flows[g];
  }
  if (!any(some)) return;

  const auto map = quad_map(v.x, shape.quads[static_cast<std::size_t>(e.value)]);
  const auto& points = points_of<F::points>(shape, e.value);
  Lane mu_over_theta, theta_over_mu;
  const auto dilate = [&](Lane theta) {
    mu_over_theta = v.mu / theta;
    theta_over_mu = theta * v.over_mu;
  };
  if constexpr (F::volumes < F::points) dilate(mean_dilatation(map, points));
  for (int g = 0; g < F::points; ++g) {
    if (F::points > 1 && !any(flows[g])) continue;
    const auto f = kernels::deformation_gradient(
        map_gradient<F::points>(map, g), points[static_cast<std::size_t>(g)].inverse_jacobian);
    if constexpr (F::volumes == F::points) dilate(determinant(f));
    return_point<F>(v, e, g, f, mu_over_theta, theta_over_mu, beside);
  }
  bending.keep(e, beside, points[0].determinant);
}

}  // namespace

template <class F>
[[gnu::flatten]] void j2_return_map(
    Chunk chunk, Read<Bodies> bodies, Read<Position> x, Read<ShearModulus> mu,
    Read<BulkModulus> bulk, Read<YieldStress> sigma_y, Read<HardeningModulus> hardening,
    Read<IsochoricScale<F::points>> isochoric, Write<DeviatoricStress<F::points>> s,
    Write<PlasticMetric<F::points>> metric, Write<PlasticStrain<F::points>> eps,
    Optional<Write<HourglassStress>> hourglass, Optional<Write<PlasticHourglass>> plastic,
    Optional<Write<HourglassWork>> work) {
  const Row<Particle> particle;
  const Lane shear = mu.chunk(chunk)(particle);
  const Views<F> v{
      x.chunk(chunk),   isochoric.chunk(chunk),
      s.chunk(chunk),   metric.chunk(chunk),
      eps.chunk(chunk), shear,
      1.0 / shear,      {sigma_y.chunk(chunk)(particle), hardening.chunk(chunk)(particle)}};
  const Shape& shape = bodies->shape_of_chunk(chunk);
  if constexpr (F::stabilised) {
    const Lane modulus = kernels::plane_strain_modulus(shear, bulk.chunk(chunk)(particle));
    Lane spent{};
    const Bending bending{hourglass->chunk(chunk), plastic->chunk(chunk),
                          (1.0 / 3.0) * modulus / shear, 1.0 / modulus, &spent};
    for (int i = 0; i < shape.elements(); ++i)
      return_element<F>(v, bending, shape, Row<Element>(i));
    work->chunk(chunk)(particle) += spent * bodies->thickness;
  } else {
    for (int i = 0; i < shape.elements(); ++i)
      return_element<F>(v, NoBending{}, shape, Row<Element>(i));
  }
}
template decltype(j2_return_map<FourPoint>) j2_return_map<FourPoint>;
template decltype(j2_return_map<Standard>) j2_return_map<Standard>;
template decltype(j2_return_map<OnePoint>) j2_return_map<OnePoint>;

}  // namespace pulvis
