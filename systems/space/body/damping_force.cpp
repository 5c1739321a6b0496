// damping_force: bulk damping of the particles, proportional to mass and to stiffness:
//   f = -alpha M v - beta K v
//
// Source   systems/space/body/damping_kernel.hpp; force, velocities and work as in two dimensions
//          (systems/body/damping_force.cpp)
// Runs     after the stress forces, before integrate
// Active   if a material of the scene has [material.damping]
#include "systems/body/damping_force.hpp"
#include "components/run_state.hpp"
#include "engine/access.hpp"
#include "engine/entry.hpp"
#include "systems/space/body/damping_kernel.hpp"
#include "systems/space/body/element_force.hpp"

namespace pulvis::space {
namespace {

using ViscosityOfPart = kernels::Viscosity<Packet>;

// An element's modes now and half a step back, and their rates.
struct MovingModes {
  kernels::ElementModes<Packet> now, middle, rate;
};

// One point, plus its hourglass modes.
template <class Force>
void add_viscous_force(OnePoint, const Force& force, const MovingModes& m,
                       const ViscosityOfPart& viscosity, const Shape& shape, Row<Element> e) {
  const Shape::Element& element = entry(shape.element, e);
  const auto f = kernels::deformation_gradient(m.middle, element.gradient);
  const auto adj = kernels::adjugate(f);
  const Packet inv_j = 1.0 / kernels::determinant(f, adj);
  const auto l = kernels::velocity_gradient(kernels::deformation_gradient(m.rate, element.gradient),
                                            adj, inv_j);
  const auto d = kernels::symmetric_part(l);
  const PointAt at =
      point_at(e, 0, element.volume, kernels::deformation_gradient(m.now, element.gradient));
  const auto s = kernels::scaled_deviator(d, viscosity.shear * at.inv_j);
  const Packet mean =
      kernels::viscous_mean_stress(viscosity.bulk, at.j, at.inv_j, kernels::trace(d));
  const auto strain = kernels::hourglass_strain(
      kernels::hourglass_rates(m.middle, m.rate, l, kernels::to_fibres(element.fibre, adj, inv_j)),
      element);
  const auto y =
      kernels::hourglass_force(kernels::hourglass_stress(strain, viscosity.moduli),
                               kernels::to_fibres(element.fibre, at.adj, at.inv_j), element);
  add_one_point_forces(force, at, entry(shape.hexahedra, e),
                       weighted_stress(s, element.volume, element.volume * mean), y,
                       kernels::hourglass_moment(y, m.now), element.gradient);
}

// Eight points with mean dilatation.
template <class Force>
void add_viscous_force(EightPoint, const Force& force, const MovingModes& m,
                       const ViscosityOfPart& viscosity, const Shape& shape, Row<Element> e) {
  const auto& points = entry(shape.gauss, e);
  const EightPoints now = eight_points(m.now, points, e);
  kernels::Symmetric3<Packet> d[8];
  Packet growth{}, volume{};  // of the element half a step back
  for (int g = 0; g < 8; ++g) {
    const Shape::GaussPoint& point = entry(points, g);
    const auto xi = kernels::gauss_coordinates(g);
    const auto f = kernels::point_gradient(m.middle, point.inverse_jacobian, xi);
    const auto adj = kernels::adjugate(f);
    const Packet j = kernels::determinant(f, adj);
    d[g] = kernels::symmetric_part(kernels::velocity_gradient(
        kernels::point_gradient(m.rate, point.inverse_jacobian, xi), adj, 1.0 / j));
    volume = fma(j, point.volume, volume);
    growth = fma(j * kernels::trace(d[g]), point.volume, growth);
  }
  const Packet inv_theta = 1.0 / now.theta;
  const Packet mean =
      kernels::viscous_mean_stress(viscosity.bulk, now.theta, inv_theta, growth / volume);
  kernels::ElementModes<Packet> sum{};
  for (int g = 0; g < 8; ++g) {
    const PointAt& at = now.at[g];
    const auto s = kernels::scaled_deviator(d[g], viscosity.shear * inv_theta);
    add_point_stress(sum, at,
                     weighted_stress(s, now.theta * at.inv_j * at.volume, mean * at.volume),
                     entry(points, g).inverse_jacobian);
  }
  add_force(force, entry(shape.hexahedra, e), 0, sum.x);
  add_force(force, entry(shape.hexahedra, e), 1, sum.y);
  add_force(force, entry(shape.hexahedra, e), 2, sum.z);
}

}  // namespace

template <class F>
[[gnu::flatten]] void damping_force<F>::operator()(Chunk chunk) const {
  const Row<Particle> particle;
  const Shape& shape = bodies.shape_of(chunk);
  for (int part = 0; part < parts_of_a_lane; ++part) {
    const auto of_part = [&](const auto& column) { return part_of(column.chunk(chunk), part); };
    damp(*this, chunk, of_part,
         [&](const auto& force, const auto& x, const auto& v, const Packet& beta) {
           const Packet mu = of_part(material.elastic.shear)(particle),
                        k = of_part(material.elastic.bulk)(particle);
           const auto moduli = kernels::hourglass_moduli(mu, k);
           const ViscosityOfPart viscosity{
               2.0 * beta * mu,
               beta * k,
               {beta * moduli.plate, beta * moduli.shear, beta * moduli.last}};
           for (int i = 0; i < shape.elements(); ++i) {
             const Hexahedron& nodes = entry(shape.hexahedra, i);
             MovingModes m{element_modes(x, nodes), {}, element_modes(v, nodes)};
             m.middle = kernels::halfway_back(m.now, m.rate, 0.5 * clock->dt_before);
             add_viscous_force(F{}, force, m, viscosity, shape, Row<Element>(i));
           }
         });
  }
}
template struct damping_force<OnePoint>;
template struct damping_force<EightPoint>;

}  // namespace pulvis::space
