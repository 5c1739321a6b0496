// internal_force: nodal forces of the stresses.
//
// Source   systems/element_kernel.hpp; the deviator acts pointwise, scaled theta/J to the Kirchhoff
//          stress of the point; the mean stress acts on the element's area: both are the exact
//          derivative of the element's stored energy (mean dilatation)
// Runs     after the stresses are final, before integrate
#include "systems/element_access.hpp"
#include "systems/systems.hpp"

namespace pulvis {

[[gnu::flatten]] void internal_force(Chunk chunk, Read<Bodies> bodies, Read<Position> x,
                                     Read<DeviatoricStress> s, Read<MeanStress> p,
                                     Write<InternalForce> force) {
  const Shape& shape = bodies->shape_of_chunk(chunk);
  const auto nodes = x.chunk(chunk);
  const auto stress = s.chunk(chunk);
  const auto mean = p.chunk(chunk);
  const auto f = force.chunk(chunk);
  for (int n = 0; n < static_cast<int>(shape.nodes.size()); ++n)
    f(Row<Node>(n), 0) = f(Row<Node>(n), 1) = Lane{};

  for (int i = 0; i < shape.elements(); ++i) {
    const Row<Element> e(i);
    const Quad& quad = shape.quads[static_cast<std::size_t>(i)];
    const ElementGauss& gauss = shape.gauss[static_cast<std::size_t>(i)];
    const auto map = quad_map(nodes, quad);
    const Lane theta = dilatation(map, gauss);
    const Lane sigma_m = mean(e);
    kernels::Matrix2<Lane> gradient[gauss_points];
    Lane now[gauss_points];
    for (int g = 0; g < gauss_points; ++g) {
      gradient[g] = map_gradient(map, g);
      now[g] = determinant(gradient[g]);
    }
    // A division for two points: it is the dearest operation of the loop.
    const Lane over[2] = {theta / (now[0] * now[1]), theta / (now[2] * now[3])};
    kernels::QuadFlux<Lane> flux;
    for (int g = 0; g < gauss_points; ++g) {
      const auto& a = gradient[g];
      const Lane kirchhoff =
          over[g / 2] * now[g ^ 1] * gauss[static_cast<std::size_t>(g)].determinant;
      const auto d = deviator(stress, e, g);
      kernels::add_flux(flux, a, kirchhoff * d.xx + sigma_m, kirchhoff * d.yy + sigma_m,
                        kirchhoff * d.xy, kernels::gauss_xi[g], kernels::gauss_eta[g]);
    }
    const auto out = kernels::node_forces(flux, 0.25 * bodies->thickness);
    for (std::size_t k = 0; k < 4; ++k) {
      f(quad[k], 0) += out.x[k];
      f(quad[k], 1) += out.y[k];
    }
  }
}

}  // namespace pulvis
