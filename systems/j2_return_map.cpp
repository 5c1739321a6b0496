// j2_return_map: brings trial stresses that left the von Mises yield surface back onto it.
//
// Source   systems/j2_kernel.hpp (Simo & Hughes 1998, box 9.1)
// Runs     after trial_stress, before internal_force
// Active   when a material of the scene declares a yield stress
#include "systems/element_access.hpp"
#include "systems/systems.hpp"

namespace pulvis {

[[gnu::flatten]] void j2_return_map(Chunk chunk, Read<Bodies> bodies, Read<Position> x,
                                    Read<ShearModulus> mu, Read<YieldStress> sigma_y,
                                    Read<HardeningModulus> hardening,
                                    Read<IsochoricScale> isochoric, Write<DeviatoricStress> s,
                                    Write<PlasticMetric> metric, Write<PlasticStrain> eps) {
  const Row<Particle> particle;
  const Lane shear = mu.chunk(chunk)(particle), over_shear = 1.0 / shear;
  const kernels::LinearHardening<Lane> law{sigma_y.chunk(chunk)(particle),
                                           hardening.chunk(chunk)(particle)};
  const auto nodes = x.chunk(chunk);
  const auto stress = s.chunk(chunk);
  const auto c = metric.chunk(chunk);
  const auto strain = eps.chunk(chunk);
  const auto scale = isochoric.chunk(chunk);
  const Shape& shape = bodies->shape_of_chunk(chunk);

  for (int i = 0; i < shape.elements(); ++i) {
    const Row<Element> e(i);
    LaneMask flows[gauss_points], some{};
    for (int g = 0; g < gauss_points; ++g) {
      flows[g] = kernels::yields(deviator(stress, e, g), strain(e, g), law);
      some |= flows[g];
    }
    if (!any(some)) continue;

    const auto map = quad_map(nodes, shape.quads[static_cast<std::size_t>(i)]);
    const ElementGauss& gauss = shape.gauss[static_cast<std::size_t>(i)];
    const Lane theta = dilatation(map, gauss);
    const Lane mu_over_theta = shear / theta, theta_over_mu = theta * over_shear;
    for (int g = 0; g < gauss_points; ++g) {
      if (!any(flows[g])) continue;
      const auto f = kernels::deformation_gradient(
          map_gradient(map, g), gauss[static_cast<std::size_t>(g)].inverse_jacobian);
      const auto next = kernels::radial_return<Lane>(
          {deviator(stress, e, g), plastic_metric(c, e, g), strain(e, g)}, f, scale(e, g),
          mu_over_theta, theta_over_mu, law);
      store(stress, e, g, next.s);
      c(e, 4 * g) = next.c.xx;
      c(e, 4 * g + 1) = next.c.yy;
      c(e, 4 * g + 2) = next.c.zz;
      c(e, 4 * g + 3) = next.c.xy;
      strain(e, g) = next.eps;
    }
  }
}

}  // namespace pulvis
