// The element computation in a step, shared by elastic_force and plastic_force: from nodal positions to
// stress and nodal forces, with all intermediate values in registers.
//
// Material: what a material adds to elasticity, for both formulations:
//   left(f, e, g)                        F C_p^-1 F^T at point g
//   remove_plastic(e, strain)            subtracts the plastic part of the hourglass strains
//   flow(PointAt, Deviator&)             returns a deviator to the yield surface
//   flow(PointAt, Deviator&, Hourglass& stress, const Hourglass& strain)   same, with the hourglass stress
#pragma once

#include "systems/space/body/element_access.hpp"
#include "systems/space/body/inversion_barrier_kernel.hpp"
#include "systems/space/body/systems.hpp"

namespace pulvis::space {

template <class F>
struct ForceViews {
  ReadPart<Position<ThreeD>> x;
  WritePart<DeviatoricStress<ThreeD, F::points>> deviator;
  WritePart<MeanStress<1>> mean;
  WritePart<InternalForce<ThreeD>> force;
  Packet mu, inv_mu, bulk;
  kernels::HourglassModuli<Packet> moduli;
};

// An integration point of an element and its deformation.
struct PointAt {
  Row<Element> element;
  int g;
  double volume;  // m^3, undeformed
  kernels::Matrix3<Packet> f, adj;
  Packet j, inv_j, r2;  // det F, 1/J, J^(-2/3)
};

inline PointAt point_at(Row<Element> e, int g, double volume, const kernels::Matrix3<Packet>& f) {
  const auto adj = kernels::adjugate(f);
  const Packet j = kernels::determinant(f, adj), r = kernels::inverse_cube_root(j), r2 = r * r;
  return {e, g, volume, f, adj, j, r2 * r, r2};
}

// Stress times volume and det F, before the pull-back: P V = `weighted` F^-T J.
inline kernels::Matrix3<Packet> weighted_stress(const kernels::Deviator<Packet>& s, Packet by,
                                                Packet mean) {
  const Packet xy = by * s.xy, yz = by * s.yz, zx = by * s.zx;
  return {fma(by, s.xx, mean), xy, zx, xy, fma(by, s.yy, mean), yz, zx, yz, fma(by, s.zz(), mean)};
}

template <class Force>
void add_force(const Force& force, const Hexahedron& nodes, int k,
               const kernels::Modes<Packet>& modes) {
  kernels::spread_force(modes, [&](int i, Packet f) { force(entry(nodes, i), k) += f; });
}

// Row of P V.
inline kernels::Vector3<Packet> pulled_back(const kernels::Matrix3<Packet>& adj, Packet x, Packet y,
                                            Packet z) {
  return kernels::transposed_product(
      kernels::Matrix3<Packet>{adj.xx, adj.yx, adj.zx, adj.xy, adj.yy, adj.zy, adj.xz, adj.yz,
                               adj.zz},
      kernels::Vector3<Packet>{x, y, z});
}

// ---- one point -----------------------------------------------------------------------------------------
template <class Force>
void add_one_point_forces(const Force& of_nodes, const PointAt& at, const Hexahedron& nodes,
                          const kernels::Matrix3<Packet>& stress,
                          const kernels::HourglassForce<Packet>& y,
                          const kernels::Matrix3<Packet>& moment, const kernels::Gradient& g) {
  const auto row = [&](int k, Packet sx, Packet sy, Packet sz, kernels::Modes<Packet> force) {
    kernels::add_gradient_force(force, pulled_back(at.adj, sx, sy, sz), g);
    add_force(of_nodes, nodes, k, force);
  };
  const Packet zero{};
  const auto less = [&](Packet s, Packet m) { return fma(-at.inv_j, m, s); };
  row(0, less(stress.xx, moment.xx), less(stress.xy, moment.xy), less(stress.xz, moment.xz),
      {zero, zero, zero, y.ez.x, y.zx.x, y.xe.x, y.xez.x});
  row(1, less(stress.yx, moment.yx), less(stress.yy, moment.yy), less(stress.yz, moment.yz),
      {zero, zero, zero, y.ez.y, y.zx.y, y.xe.y, y.xez.y});
  row(2, less(stress.zx, moment.zx), less(stress.zy, moment.zy), less(stress.zz, moment.zz),
      {zero, zero, zero, y.ez.z, y.zx.z, y.xe.z, y.xez.z});
}

// Returns the minimum det F over the Gauss points. Rarely called; takes a copy of the views so that these stay in
// registers elsewhere.
[[gnu::noinline, gnu::cold]] inline Packet add_barrier_force(ForceViews<OnePoint> v,
                                                             const Shape& shape, Row<Element> e) {
  const Hexahedron& nodes = entry(shape.hexahedra, e);
  const auto barrier = kernels::inversion_barrier(element_modes(v.x, nodes), entry(shape.gauss, e),
                                                  entry(shape.element, e), v.mu);
  for (int k = 0; k < 3; ++k) add_force(v.force, nodes, k, entry(barrier.force, k));
  return barrier.least;
}

// Returns det F of the element; if a corner may be inverting, the minimum of that and of the Gauss points.
template <class Material>
Packet element_force(const ForceViews<OnePoint>& v, Material& material, const Shape& shape,
                     Row<Element> e) {
  const Shape::Element& element = entry(shape.element, e);
  const Hexahedron& nodes = entry(shape.hexahedra, e);
  const auto modes = element_modes(v.x, nodes);
  const PointAt at =
      point_at(e, 0, element.volume, kernels::deformation_gradient(modes, element.gradient));
  const auto to = kernels::to_fibres(element.fibre, at.adj, at.inv_j);
  const auto components = kernels::hourglass_components(modes, to, element);
  const Packet closing = kernels::closing_measure(components, element);
  auto strain = kernels::hourglass_strain(components, element);
  material.remove_plastic(e, strain);
  auto bending = kernels::hourglass_stress(strain, v.moduli);
  auto s = kernels::scaled_deviator(material.left(at.f, e, 0), v.mu * at.inv_j * at.r2);
  material.flow(at, s, bending, strain);

  const Packet mean = kernels::mean_stress(v.bulk, at.j, at.inv_j);
  store(v.deviator, e, 0, s);
  v.mean(e) = mean;
  const auto y = kernels::hourglass_force(bending, to, element);
  add_one_point_forces(v.force, at, nodes,
                       weighted_stress(s, element.volume, element.volume * mean), y,
                       kernels::hourglass_moment(y, modes), element.gradient);
  const Packet::Mask may_close = ~(closing < 1.0);
  if (!any(may_close)) return at.j;
  return select(may_close, min(add_barrier_force(v, shape, e), at.j), at.j);
}

// ---- eight points, one dilatation --------------------------------------------------------------------------
struct EightPoints {
  PointAt at[8];
  Packet theta, least;
};

inline EightPoints eight_points(const kernels::ElementModes<Packet>& modes,
                                const std::array<Shape::GaussPoint, 8>& points, Row<Element> e) {
  EightPoints p;
  p.least = 1e300;
  Packet now{};
  double before = 0;
  for (int g = 0; g < 8; ++g) {
    const Shape::GaussPoint& point = entry(points, g);
    p.at[g] = point_at(
        e, g, point.volume,
        kernels::point_gradient(modes, point.inverse_jacobian, kernels::gauss_coordinates(g)));
    now = fma(p.at[g].j, point.volume, now);
    before += point.volume;
    p.least = min(p.at[g].j, p.least);
  }
  p.theta = now * (1 / before);
  return p;
}

// `stress`: multiplied by volume and det F.
inline void add_point_stress(kernels::ElementModes<Packet>& force, const PointAt& at,
                             const kernels::Matrix3<Packet>& stress, const Tensor& inverse) {
  const auto row = [&](kernels::Modes<Packet>& of_force, Packet x, Packet y, Packet z) {
    kernels::add_point_force(of_force, pulled_back(at.adj, x, y, z), inverse,
                             kernels::gauss_coordinates(at.g));
  };
  row(force.x, stress.xx, stress.xy, stress.xz);
  row(force.y, stress.yx, stress.yy, stress.yz);
  row(force.z, stress.zx, stress.zy, stress.zz);
}

template <class Material>
Packet element_force(const ForceViews<EightPoint>& v, Material& material, const Shape& shape,
                     Row<Element> e) {
  const Hexahedron& nodes = entry(shape.hexahedra, e);
  const auto& points = entry(shape.gauss, e);
  const auto modes = element_modes(v.x, nodes);
  const EightPoints p = eight_points(modes, points, e);
  const Packet inv_theta = 1.0 / p.theta, mean = kernels::mean_stress(v.bulk, p.theta, inv_theta);
  v.mean(e) = mean;
  kernels::ElementModes<Packet> force{};
  for (int g = 0; g < 8; ++g) {
    PointAt at = p.at[g];
    auto s = kernels::scaled_deviator(material.left(at.f, e, g), v.mu * inv_theta * at.r2);
    // The deviator of Cauchy stress is divided by theta, not by the J of the point.
    const Packet inv_j = at.inv_j;
    at.j = p.theta;
    at.inv_j = inv_theta;
    material.flow(at, s);
    store(v.deviator, e, g, s);
    const auto stress = weighted_stress(s, p.theta * inv_j * at.volume, mean * at.volume);
    add_point_stress(force, at, stress, entry(points, g).inverse_jacobian);
  }
  add_force(v.force, nodes, 0, force.x);
  add_force(v.force, nodes, 1, force.y);
  add_force(v.force, nodes, 2, force.z);
  // A NaN of the volume comes from a point; min keeps it only in the last point.
  return select(p.theta == p.theta, p.least, p.theta);
}

// ---- one register of particles -----------------------------------------------------------------------------
template <class F>
ForceViews<F> force_views(const Read<Position<ThreeD>>& position, const Elasticity& elastic,
                          const ForceResults<F>& results, Chunk chunk, int part) {
  const Row<Particle> particle;
  const Packet mu = part_of(elastic.shear.chunk(chunk), part)(particle),
               bulk = part_of(elastic.bulk.chunk(chunk), part)(particle);
  return {part_of(position.chunk(chunk), part),
          part_of(results.stress.deviator.chunk(chunk), part),
          part_of(results.stress.mean.chunk(chunk), part),
          part_of(results.force.chunk(chunk), part),
          mu,
          1.0 / mu,
          bulk,
          kernels::hourglass_moduli(mu, bulk)};
}

// A NaN wins every comparison and is not overwritten by later values, so that it is detected.
inline void keep_worst(Packet minimum, Row<Element> e, Packet& worst, Packet& worst_element) {
  const Packet::Mask lower = ~(minimum >= worst) & (worst == worst);
  worst_element = select(lower, e.value, worst_element);
  worst = select(lower, minimum, worst);
}

template <class F, class Material>
void part_force(BusyChunk chunk, int part, const Shape& shape, const ForceViews<F>& v,
                const WorstJacobian<Write>& worst_jacobian, Material& material) {
  for (int n = 0; n < static_cast<int>(shape.nodes.size()); ++n)
    for (int k = 0; k < 3; ++k) v.force(Row<Node>(n), k) = Packet{};
  Packet worst = 1e300, which{};
  chunk.for_elements(shape.elements(), [&](int i) {
    const Row<Element> e(i);
    keep_worst(element_force(v, material, shape, e), e, worst, which);
  });
  const Row<Particle> particle;
  part_of(worst_jacobian.value.chunk(chunk), part)(particle) = worst;
  part_of(worst_jacobian.element.chunk(chunk), part)(particle) = which;
}

}  // namespace pulvis::space
