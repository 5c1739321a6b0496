#include "systems/space/body/element_stiffness.hpp"

#include "systems/space/body/element_bound.hpp"
#include "systems/space/body/stiffness_kernel.hpp"

namespace pulvis::space {
namespace {

using Rows = std::array<kernels::Vector3<Lane>, 3>;
using Forces = std::array<kernels::Modes<Lane>, 3>;

void add_to_nodes(const ModeView<ThreeD>& mode, const Hexahedron& nodes, const Forces& forces,
                  const Lane& factor) {
  for (int k = 0; k < 3; ++k)
    kernels::spread_force(entry(forces, k), [&](int i, const Lane& f) {
      mode(entry(nodes, i), 3 + k) += factor * f;
    });
}

// |dev b'| at a point, from its stress.
template <class View>
Lane distortion_at(const View& stress, Row<Element> e, int g, const Lane& theta, const Lane& mu) {
  return theta * sqrt(kernels::squared_norm(deviator_at(stress, e, g))) / mu;
}

}  // namespace

// A corner that may be inverting raises the stiffness as in the element bound.
[[gnu::flatten]] void subtract_stiffness(const ModeBody<OnePoint>& body, Row<Element> e,
                                         const ModeView<ThreeD>& mode) {
  const Shape::Element& element = entry(body.shape.element, e);
  const Hexahedron& nodes = entry(body.shape.hexahedra, e);
  const auto now = element_modes(body.x, nodes), rate = element_modes(mode, nodes);
  const auto f = kernels::deformation_gradient(now, element.gradient);
  const auto at = kernels::moving_point(f, kernels::deformation_gradient(rate, element.gradient));
  const auto c = kernels::tangent_of_element(body.bulk, body.shear, at.j, growth_of(at));
  const auto tau =
      kernels::tangent_stress(c, at, distortion_at(body.stress, e, 0, at.j, body.shear));
  Forces forces = kernels::tangent_of_hourglass(now, rate, at, element,
                                                kernels::hourglass_moduli(body.shear, body.bulk));
  const Rows rows = kernels::tangent_rows(tau, at, Lane(element.volume));
  for (std::size_t k = 0; k < 3; ++k)
    kernels::add_gradient_force(forces[k], rows[k], element.gradient);
  add_to_nodes(mode, nodes, forces, closing_factor(now, f, element, entry(body.shape.gauss, e)));
}

[[gnu::flatten]] void subtract_stiffness(const ModeBody<EightPoint>& body, Row<Element> e,
                                         const ModeView<ThreeD>& mode) {
  const Hexahedron& nodes = entry(body.shape.hexahedra, e);
  const auto& points = entry(body.shape.gauss, e);
  const auto now = element_modes(body.x, nodes), rate = element_modes(mode, nodes);
  std::array<kernels::MovingPoint<Lane>, 8> at;
  Lane content{}, growth{};
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
  const Lane theta = content * (1 / before);
  const auto c = kernels::tangent_of_element(body.bulk, body.shear, theta, growth * (1 / before));
  Forces forces{};
  for (int g = 0; g < 8; ++g) {
    const auto tau = kernels::tangent_stress(c, entry(at, g),
                                             distortion_at(body.stress, e, g, theta, body.shear));
    const Rows rows = kernels::tangent_rows(tau, entry(at, g), Lane(entry(points, g).volume));
    for (std::size_t k = 0; k < 3; ++k)
      kernels::add_point_force(forces[k], rows[k], entry(points, g).inverse_jacobian,
                               kernels::gauss_coordinates(g));
  }
  add_to_nodes(mode, nodes, forces, Lane(1.0));
}

}  // namespace pulvis::space

namespace pulvis {

template struct highest_mode<space::OnePoint>;
template struct highest_mode<space::EightPoint>;

}  // namespace pulvis
