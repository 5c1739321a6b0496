// highest_mode of quads: elastic forces of highest_mode_kernel.hpp.
#include "systems/body/highest_mode.hpp"
#include "systems/body/highest_mode_kernel.hpp"

namespace pulvis {

template <class F>
void subtract_stiffness(const ModeBody<F>& body, Row<Element> e, const ModeView<TwoD>& mode) {
  const Quad& q = entry(body.shape.quads, e);
  const auto map = quad_map<4>(body.x, q);
  const double area = entry(body.shape.centre, e)[0].determinant;
  const Lane theta = determinant(map_gradient<1>(map, 0)) * (4 / area);
  const Lane distortion = theta * (1.0 / body.shear) * largest_norm<F::points>(body.stress, e);
  const auto flux = kernels::tangent_flux(
      map, quad_map<4>(mode, q), kernels::tangent_moduli(body.bulk, body.shear, theta, distortion),
      Lane(area), corner_factor(map));
  const auto out = kernels::node_forces(flux, 0.25);
  for (std::size_t k = 0; k < 4; ++k) {
    mode(q[k], 2) += out.x[k];
    mode(q[k], 3) += out.y[k];
  }
}

template struct highest_mode<FourPoint>;
template struct highest_mode<Standard>;
template struct highest_mode<OnePoint>;

}  // namespace pulvis
