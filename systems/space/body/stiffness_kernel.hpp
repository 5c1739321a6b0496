// Elastic forces of a hexahedron under a small motion v, never softer than the element used in the run.
//
// With H = dv/dx at each integration point (of one-point elements: the mean gradient), J its det F, and theta the dilatation
// of the element, the second derivative of the energy per undeformed volume gives
//   tau = c growth J 1 + lambda tr(H) 1 + a H + b H^T,   c = K/2 (1 + 1/theta^2),   p = K/2 (theta - 1/theta)
//   growth = mean of J tr(H),   lambda = p J - 2/3 mu,   a = mu + 2 d,   b = mu - p J
// exactly if the element has no elastic distortion, which d bounds as in time_step_kernel.hpp. Under pressures near mu this
// has negative eigenvalues, which the iteration would take for the highest: a is at least |b|.
// Hourglass modes of one-point elements: the stress of the rates of their strains, with the moduli of the run.
#pragma once

#include "systems/space/body/damping_kernel.hpp"

namespace pulvis::space::kernels {

// An integration point under the motion.
template <class T>
struct MovingPoint {
  Matrix3<T> h, adj;  // 1/s, -
  T j, inv_j;
};
// `f`, `rate`: deformation gradient, and that of the motion.
template <class T>
MovingPoint<T> moving_point(const Matrix3<T>& f, const Matrix3<T>& rate) {
  const auto adj = adjugate(f);
  const T j = determinant(f, adj), inv_j = 1.0 / j;
  return {velocity_gradient(rate, adj, inv_j), adj, j, inv_j};
}
template <class T>
T growth_of(const MovingPoint<T>& at) {
  return at.j * (at.h.xx + at.h.yy + at.h.zz);
}

template <class T>
struct TangentOfElement {
  T mu;        // Pa
  T pressure;  // Pa, p
  T uniform;   // Pa, c growth
};
template <class T>
TangentOfElement<T> tangent_of_element(T bulk, T mu, T theta, T growth) {
  const T over = 1.0 / theta;
  return {mu, mean_stress(bulk, theta, over), 0.5 * bulk * (1.0 + over * over) * growth};
}

// tau. `distortion`: |dev b'|.
template <class T>
Matrix3<T> tangent_stress(const TangentOfElement<T>& c, const MovingPoint<T>& at, T distortion) {
  const Matrix3<T>& h = at.h;
  const T p = c.pressure * at.j;
  const T b = c.mu - p, a = max(c.mu + 2.3 * (distortion * c.mu), abs(b)), both = a + b;
  const T all = c.uniform * at.j + (p - (2.0 / 3.0) * c.mu) * (h.xx + h.yy + h.zz);
  return {all + both * h.xx,   a * h.xy + b * h.yx, a * h.xz + b * h.zx,
          a * h.yx + b * h.xy, all + both * h.yy,   a * h.yz + b * h.zy,
          a * h.zx + b * h.xz, a * h.zy + b * h.yz, all + both * h.zz};
}

// Rows of P V from tau and the undeformed volume.
template <class T>
std::array<Vector3<T>, 3> tangent_rows(const Matrix3<T>& tau, const MovingPoint<T>& at, T volume) {
  const T by = volume * at.inv_j;
  const auto row = [&](T x, T y, T z) {
    const Vector3<T> p = product(at.adj, Vector3<T>{x, y, z});
    return Vector3<T>{by * p.x, by * p.y, by * p.z};
  };
  return {row(tau.xx, tau.xy, tau.xz), row(tau.yx, tau.yy, tau.yz), row(tau.zx, tau.zy, tau.zz)};
}

// Forces of the hourglass modes of a one-point element on the modes of its nodes. `now`: its modes.
template <class T>
std::array<Modes<T>, 3> tangent_of_hourglass(const ElementModes<T>& now,
                                             const ElementModes<T>& rate, const MovingPoint<T>& at,
                                             const Shape::Element& element,
                                             const HourglassModuli<T>& moduli) {
  const auto to = to_fibres(element.fibre, at.adj, at.inv_j);
  const auto strain = hourglass_strain(hourglass_rates(now, rate, at.h, to), element);
  const auto y = hourglass_force(hourglass_stress(strain, moduli), to, element);
  const T zero{};
  std::array<Modes<T>, 3> force{Modes<T>{zero, zero, zero, y.ez.x, y.zx.x, y.xe.x, y.xez.x},
                                Modes<T>{zero, zero, zero, y.ez.y, y.zx.y, y.xe.y, y.xez.y},
                                Modes<T>{zero, zero, zero, y.ez.z, y.zx.z, y.xe.z, y.xez.z}};
  const auto rows = tangent_rows(hourglass_moment(y, now), at, T{} - 1.0);
  for (std::size_t k = 0; k < 3; ++k) add_gradient_force(force[k], rows[k], element.gradient);
  return force;
}

}  // namespace pulvis::space::kernels
