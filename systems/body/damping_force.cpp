// damping_force: bulk damping of the particles, mass- and stiffness-proportional:
//   f = -alpha M v - beta K v
//
// Source   systems/body/damping_kernel.hpp. The force is added to the internal one, like a constraint's reaction,
//          so that every reader of the nodal force sees it. Velocities are those half a step back, which the
//          stable time step allows for. Work by the trapezoidal rule over each step, from the forces at
//          both of its ends: what the leapfrog removes from its kinetic energy (systems/body/energies.cpp)
// Runs     after internal_force, before apply_constraints and integrate
// Active   when a material of the scene has [material.damping]
#include "systems/body/damping_force.hpp"
#include "components/run_state.hpp"
#include "engine/access.hpp"
#include "engine/entry.hpp"
#include "systems/body/damping_kernel.hpp"
#include "systems/body/element_access.hpp"
#include "systems/body/systems.hpp"

namespace pulvis {
namespace {

using Map = kernels::QuadMap<Lane>;
using Flux = kernels::QuadFlux<Lane>;

struct Viscosity {
  Lane shear, bulk, bending;  // Pa s: beta times 2 mu, K, E'
};

// The map of an element now and half a step back, and the map of its velocities.
struct Maps {
  Map now, middle, rate;
};

Map halfway_back(const Map& now, const Map& rate, double half_step) {
  return {now.ax - half_step * rate.ax, now.ay - half_step * rate.ay, now.bx - half_step * rate.bx,
          now.by - half_step * rate.by, now.hx - half_step * rate.hx, now.hy - half_step * rate.hy};
}

// Strain rate at a point, and det A there half a step back and now.
struct PointRate {
  kernels::StrainRate<Lane> strain;
  kernels::Matrix2<Lane> map;
  Lane before, now;
};
PointRate point_rate(const Maps& m, double xi, double eta) {
  const auto a = kernels::map_gradient(m.middle, xi, eta);
  const auto now = kernels::map_gradient(m.now, xi, eta);
  return {kernels::strain_rate(a, kernels::map_gradient(m.rate, xi, eta)), now, determinant(a),
          determinant(now)};
}

// One point, plus the bending that it does not see.
Flux viscous_flux(OnePoint, const Maps& m, const Viscosity& v, const Shape& shape, std::size_t e) {
  const double area = shape.centre[e][0].determinant;
  const PointRate at = point_rate(m, 0, 0);
  const Lane theta = at.now * (4 / area);
  const auto s = kernels::viscous_stress(at.strain, at.strain.trace(), v.shear / theta,
                                         kernels::viscous_bulk_modulus(v.bulk, theta));
  auto flux = kernels::central_flux(at.map, 4.0 * s.xx, 4.0 * s.yy, 4.0 * s.xy);
  const auto& reference = shape.hourglass[e];
  const auto rate = kernels::hourglass_rate(m.middle, m.rate);
  const kernels::Hourglass<Lane> stress{v.bending * fma(reference.skew[0], rate.two, rate.one),
                                        v.bending * fma(reference.skew[1], rate.one, rate.two)};
  const Lane over = 1.0 / at.now;
  kernels::add_hourglass_flux(flux, m.now, kernels::natural_hourglass(m.now, over), over,
                              kernels::bending_moment<Lane>(stress, reference, area / 3));
  return flux;
}

// Four points; with the mean dilatation, or each with its own.
template <class F>
Flux viscous_flux(F, const Maps& m, const Viscosity& v, const Shape& shape, std::size_t e) {
  static_assert(F::points == 4, "a formulation with other points needs a viscous_flux of its own");
  PointRate at[4];
  Lane dilatation{}, before{}, now{};
  double area = 0;
  for (int g = 0; g < 4; ++g) {
    at[g] = point_rate(m, kernels::gauss_xi[g], kernels::gauss_eta[g]);
    dilatation += at[g].before * at[g].strain.trace();
    before += at[g].before;
    now += at[g].now;
    area += entry(shape.gauss[e], g).determinant;
  }
  Flux flux;
  for (int g = 0; g < 4; ++g) {
    const Lane j = at[g].now * (1 / entry(shape.gauss[e], g).determinant);
    const bool own = F::volumes == F::points;
    const Lane theta = own ? j : now * (1 / area);
    const auto s =
        kernels::viscous_stress(at[g].strain, own ? at[g].strain.trace() : dilatation / before,
                                v.shear / j, kernels::viscous_bulk_modulus(v.bulk, theta));
    kernels::add_flux(flux, at[g].map, s.xx, s.yy, s.xy, kernels::gauss_xi[g],
                      kernels::gauss_eta[g]);
  }
  return flux;
}

template <class F, class Nodes, class Velocities, class Forces>
void add_viscous_forces(const Shape& shape, const Nodes& x, const Velocities& v,
                        const Viscosity& viscosity, double half_step, double thickness,
                        const Forces& force) {
  for (std::size_t e = 0; e < shape.quads.size(); ++e) {
    const Quad& q = shape.quads[e];
    const Map now = quad_map<4>(x, q), rate = quad_map<4>(v, q);
    const auto flux =
        viscous_flux(F{}, {now, halfway_back(now, rate, half_step), rate}, viscosity, shape, e);
    const auto out = kernels::node_forces(flux, 0.25 * thickness);
    for (std::size_t k = 0; k < 4; ++k) {
      force(q[k], 0) += out.x[k];
      force(q[k], 1) += out.y[k];
    }
  }
}

}  // namespace

template <class F>
[[gnu::flatten]] void damping_force<F>::operator()(Chunk chunk) const {
  const Row<Particle> particle;
  const auto of_chunk = [&](const auto& column) { return column.chunk(chunk); };
  damp(*this, chunk, of_chunk,
       [&](const auto& force, const auto& x, const auto& v, const Lane& beta) {
         const Lane shear = of_chunk(material.elastic.shear)(particle),
                    k = of_chunk(material.elastic.bulk)(particle);
         const Viscosity viscosity{2.0 * beta * shear, beta * k,
                                   beta * kernels::plane_strain_modulus(shear, k)};
         add_viscous_forces<F>(bodies.shape_of(chunk), x, v, viscosity, 0.5 * clock->dt_before,
                               bodies.depth(), force);
       });
}
template struct damping_force<FourPoint>;
template struct damping_force<Standard>;
template struct damping_force<OnePoint>;

}  // namespace pulvis
