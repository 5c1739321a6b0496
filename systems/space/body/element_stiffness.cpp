#include "systems/space/body/element_stiffness.hpp"

#include "systems/space/body/element_bound.hpp"
#include "systems/space/body/stiffness_kernel.hpp"

namespace pulvis::space {
namespace {

using Rows = std::array<kernels::Vector3<Packet>, 3>;
using Forces = std::array<kernels::Modes<Packet>, 3>;

// The lanes of a body in one register: of its many intermediate values more stay in registers.
template <class F>
struct BodyPart {
  const Shape& shape;
  ReadPart<Position<ThreeD>> x;
  ReadPart<DeviatoricStress<ThreeD, F::points>> stress;
  WritePart<HighestMode<ThreeD>> mode;
  Packet bulk, shear;
};

void add_to_nodes(const WritePart<HighestMode<ThreeD>>& mode, const Hexahedron& nodes,
                  const Forces& forces, const Packet& factor) {
  for (int k = 0; k < 3; ++k)
    kernels::spread_force(entry(forces, k), [&](int i, const Packet& f) {
      mode(entry(nodes, i), 3 + k) += factor * f;
    });
}

// |dev b'| at a point, from its stress.
template <class View>
Packet distortion_at(const View& stress, Row<Element> e, int g, const Packet& theta,
                     const Packet& mu) {
  return theta * sqrt(kernels::squared_norm(deviator_at(stress, e, g))) / mu;
}

// A corner that may be inverting raises the stiffness as in the element bound.
void subtract_part(const BodyPart<OnePoint>& body, Row<Element> e) {
  const Shape::Element& element = entry(body.shape.element, e);
  const Hexahedron& nodes = entry(body.shape.hexahedra, e);
  const auto now = element_modes(body.x, nodes), rate = element_modes(body.mode, nodes);
  const auto f = kernels::deformation_gradient(now, element.gradient);
  const auto at = kernels::moving_point(f, kernels::deformation_gradient(rate, element.gradient));
  const auto c = kernels::tangent_of_element(body.bulk, body.shear, at.j, growth_of(at));
  const auto tau =
      kernels::tangent_stress(c, at, distortion_at(body.stress, e, 0, at.j, body.shear));
  Forces forces = kernels::tangent_of_hourglass(now, rate, at, element,
                                                kernels::hourglass_moduli(body.shear, body.bulk));
  const Rows rows = kernels::tangent_rows(tau, at, Packet(element.volume));
  for (std::size_t k = 0; k < 3; ++k)
    kernels::add_gradient_force(forces[k], rows[k], element.gradient);
  add_to_nodes(body.mode, nodes, forces,
               closing_factor(now, f, element, entry(body.shape.gauss, e)));
}

void subtract_part(const BodyPart<EightPoint>& body, Row<Element> e) {
  const Hexahedron& nodes = entry(body.shape.hexahedra, e);
  const auto& points = entry(body.shape.gauss, e);
  const auto now = element_modes(body.x, nodes), rate = element_modes(body.mode, nodes);
  std::array<kernels::MovingPoint<Packet>, 8> at;
  Packet content{}, growth{};
  double before = 0;
  for (int g = 0; g < 8; ++g) {
    const Shape::GaussPoint& point = entry(points, g);
    const auto xi = kernels::gauss_coordinates(g);
    entry(at, g) = kernels::moving_point(kernels::point_gradient(now, point.inverse_jacobian, xi),
                                         kernels::point_gradient(rate, point.inverse_jacobian, xi));
    before += point.volume;
    content += point.volume * entry(at, g).j;
    growth += point.volume * growth_of(entry(at, g));
  }
  const Packet theta = content * (1 / before);
  const auto c = kernels::tangent_of_element(body.bulk, body.shear, theta, growth * (1 / before));
  Forces forces{};
  for (int g = 0; g < 8; ++g) {
    const auto tau = kernels::tangent_stress(c, entry(at, g),
                                             distortion_at(body.stress, e, g, theta, body.shear));
    const Rows rows = kernels::tangent_rows(tau, entry(at, g), Packet(entry(points, g).volume));
    for (std::size_t k = 0; k < 3; ++k)
      kernels::add_point_force(forces[k], rows[k], entry(points, g).inverse_jacobian,
                               kernels::gauss_coordinates(g));
  }
  add_to_nodes(body.mode, nodes, forces, Packet(1.0));
}

template <class F>
void subtract_parts(const ModeBody<F>& body, Row<Element> e, const ModeView<ThreeD>& mode) {
  for (int part = 0; part < parts_of_a_lane; ++part)
    subtract_part(
        BodyPart<F>{body.shape, part_of(body.x, part), part_of(body.stress, part),
                    part_of(mode, part), part_of(body.bulk, part), part_of(body.shear, part)},
        e);
}

}  // namespace

[[gnu::flatten]] void subtract_stiffness(const ModeBody<OnePoint>& body, Row<Element> e,
                                         const ModeView<ThreeD>& mode) {
  subtract_parts(body, e, mode);
}

[[gnu::flatten]] void subtract_stiffness(const ModeBody<EightPoint>& body, Row<Element> e,
                                         const ModeView<ThreeD>& mode) {
  subtract_parts(body, e, mode);
}

}  // namespace pulvis::space

namespace pulvis {

template struct highest_mode<space::OnePoint>;
template struct highest_mode<space::EightPoint>;

}  // namespace pulvis
