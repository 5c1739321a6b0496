// j2_return_map: brings trial stresses that left the von Mises yield surface back onto it; in elements
// with one point together with the stress of the hourglass modes.
//
// Source   systems/body/j2_kernel.hpp (Simo & Hughes 1998, box 9.1); systems/body/hourglass_kernel.hpp
// Runs     after trial_stress, before internal_force
// Active   when a material of the scene declares a yield stress
#include "systems/body/element_access.hpp"
#include "systems/body/hourglass_kernel.hpp"
#include "systems/body/systems.hpp"

namespace pulvis {
namespace {

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
                  Lane mu_over_theta, Lane theta, Beside&& beside) {
  const Lane r = v.scale(e, g);
  const auto next = kernels::radial_return<Lane>(
      {deviator(v.stress, e, g), plastic_metric(v.metric, e, g), v.strain(e, g)}, f, r * r,
      mu_over_theta, theta * v.over_mu, v.law, beside);
  store(v.stress, e, g, next.s);
  v.metric(e, 4 * g) = next.c.xx;
  v.metric(e, 4 * g + 1) = next.c.yy;
  v.metric(e, 4 * g + 2) = next.c.zz;
  v.metric(e, 4 * g + 3) = next.c.xy;
  v.strain(e, g) = next.eps;
}

template <class F>
void return_element(const Views<F>& v, const Shape& shape, Row<Element> e) {
  LaneMask flows[F::points], some = LaneMask::of(0);
  for (int g = 0; g < F::points; ++g) {
    flows[g] = kernels::yields(deviator(v.stress, e, g), v.strain(e, g), v.law);
    some = some | flows[g];
  }
  if (!any(some)) return;

  const auto map = quad_map<F::points>(v.x, shape.quads[static_cast<std::size_t>(e.value)]);
  const auto& points = points_of<F::points>(shape, e.value);
  Lane theta = mean_dilatation(map, points);
  Lane mu_over_theta = v.mu / theta;
  for (int g = 0; g < F::points; ++g) {
    if (!any(flows[g])) continue;
    const auto f = kernels::deformation_gradient(
        map_gradient<F::points>(map, g), points[static_cast<std::size_t>(g)].inverse_jacobian);
    if constexpr (F::volumes == F::points) {
      theta = determinant(f);
      mu_over_theta = v.mu / theta;
    }
    return_point(v, e, g, f, mu_over_theta, theta, kernels::NothingBeside{});
  }
}

// ---- one point: the stress of the hourglass modes goes with the deviator ---------------------------
struct Bending {
  ChunkView<HourglassStress, Lane*> stress;
  ChunkView<PlasticHourglass, Lane*> plastic;
  Lane softness, stiffness, over_modulus;
};

// Keeps the share `left` of the bending stress; the rest has become plastic. Returns the work spent in
// the hourglass modes, J/m.
Lane keep_bending(const Bending& bending, Row<Element> e, const kernels::Hourglass<Lane>& stress,
                  Lane left, double area) {
  const Lane gone = fma(-left, bending.over_modulus, bending.over_modulus);
  bending.plastic(e, 0) = fma(gone, stress.one, bending.plastic(e, 0));
  bending.plastic(e, 1) = fma(gone, stress.two, bending.plastic(e, 1));
  bending.stress(e, 0) = left * stress.one;
  bending.stress(e, 1) = left * stress.two;
  return ((1.0 / 3.0) * area) * (left * gone) *
         fma(stress.one, stress.one, stress.two * stress.two);
}

Lane return_element(const Views<OnePoint>& v, const Bending& bending, const Shape& shape,
                    Row<Element> e) {
  const auto s = deviator(v.stress, e, 0);
  const kernels::Hourglass<Lane> m{bending.stress(e, 0), bending.stress(e, 1)};
  const Lane yield = v.law.flow_stress(v.strain(e)), limit2 = (2.0 / 3.0) * yield * yield;
  if (!any(kernels::may_yield(s, m, limit2))) return Lane{};

  const auto map = quad_map<1>(v.x, shape.quads[static_cast<std::size_t>(e.value)]);
  kernels::BendingBeside<Lane> beside{m, bending.softness, bending.stiffness,
                                      kernels::inverse_width(map, s, limit2), 1.0};
  const auto& point = shape.centre[static_cast<std::size_t>(e.value)][0];
  const auto f = kernels::deformation_gradient(map_gradient<1>(map, 0), point.inverse_jacobian);
  const Lane r = v.scale(e);  // theta = det F: 1/theta is its cube
  return_point(v, e, 0, f, v.mu * (r * r * r), determinant(f), beside);
  return keep_bending(bending, e, m, beside.left, point.determinant);
}

}  // namespace

template <class F>
[[gnu::flatten]] void j2_return_map(
    BusyChunk chunk, Read<Bodies> bodies, Read<Position> x, Read<ShearModulus> mu,
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
    const Bending bending{hourglass->chunk(chunk), plastic->chunk(chunk),
                          (1.0 / 3.0) * modulus / shear, 3.0 * shear / modulus, 1.0 / modulus};
    Lane spent{};
    chunk.for_elements(shape.elements(),
                       [&](int i) { spent += return_element(v, bending, shape, Row<Element>(i)); });
    work->chunk(chunk)(particle) += spent * bodies->thickness;
  } else {
    chunk.for_elements(shape.elements(), [&](int i) { return_element(v, shape, Row<Element>(i)); });
  }
}
template decltype(j2_return_map<FourPoint>) j2_return_map<FourPoint>;
template decltype(j2_return_map<Standard>) j2_return_map<Standard>;
template decltype(j2_return_map<OnePoint>) j2_return_map<OnePoint>;

}  // namespace pulvis
