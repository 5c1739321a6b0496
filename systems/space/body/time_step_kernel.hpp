// Upper bound on the highest squared frequency of a hexahedron, in its uniform-strain modes and its hourglass modes.
//
// Uniform strain. With lumped masses m_I = rho V_I at the corners and mean gradients b_I the modes are those of C : H over
// (sum_I b_I b_I^T / m_I)^-1. In the axes of N = V sum_I b_I b_I^T / V_I [1/m^2], n_1 >= n_2 >= n_3 its eigenvalues, three
// stretches and three pairs of shears decouple:
//   stretches  (M - L) n_i on the diagonal and L sqrt(n_i n_j) everywhere: at most (M - L) n_1 + L tr N
//   shears     [[m n_i, l s], [l s, m n_j]], s = sqrt(n_i n_j): at most max(m, l) (n_1 + n_2)
// Moduli per undeformed volume of U = K/2 ((theta^2 - 1)/2 - ln theta) and the neo-Hookean deviator:
//   M = K (1 + theta^2)/2 + 4/3 mu + d,   L = |K theta^2 - 2/3 mu| + d
//   m = mu + d,                           l = |mu - K (theta^2 - 1)/2| + d
// d bounds the contribution of elastic distortion: 1.15 |dev b'| mu, as in two dimensions.
//
// Hourglass modes. The plate energy is at most max(B, mu) |e|^2 with e the strain of a plate, itself at most the gradient
// of the bending mode: rho omega^2 <= max(B, mu) |F^-1|^2 hourglass_spread.
//
// Both together: for operators of norms alpha and beta whose ranges meet at an angle of squared cosine `overlap` the
// bound is the larger eigenvalue of [[alpha, c], [c, beta]], c^2 = alpha beta overlap.
#pragma once

#include "systems/space/body/hourglass_kernel.hpp"
#include "systems/space/body/j2_kernel.hpp"

namespace pulvis::space::kernels {

// Bounds on the eigenvalues of a symmetric tensor from its trace and deviator; sharp if two are equal.
template <class T>
struct EigenvalueBounds {
  T trace, largest, largest_two;
};
template <class T>
EigenvalueBounds<T> eigenvalue_bounds(const Symmetric3<T>& n) {
  const T tr = trace(n), mean = (1.0 / 3.0) * tr;
  const T reach = sqrt((2.0 / 3.0) * squared_norm(scaled_deviator(n, T{} + 1.0)));
  return {tr, min(mean + reach, tr), tr - max(mean - reach, T{})};
}

// F^-T n F^-1, from F's adjugate and determinant.
template <class T>
Symmetric3<T> pushed_spread(const Matrix3<T>& adj, T j, const std::array<double, 6>& n) {
  const T over = 1.0 / (j * j);
  const auto m =
      congruent(Matrix3<T>{adj.xx, adj.yx, adj.zx, adj.xy, adj.yy, adj.zy, adj.xz, adj.yz, adj.zz},
                Symmetric3<T>{n[0], n[1], n[2], n[3], n[4], n[5]});
  return {m.xx * over, m.yy * over, m.zz * over, m.xy * over, m.yz * over, m.zx * over};
}

// rho omega^2, Pa/m^2. `distortion` = |dev b'|, the norm of the deviatoric Kirchhoff stress over mu.
template <class T>
T uniform_bound(const EigenvalueBounds<T>& n, T bulk, T mu, T theta, T distortion) {
  const T theta2 = theta * theta, d = 1.15 * (distortion * mu);
  const T own = 0.5 * bulk * (1.0 + theta2) + (4.0 / 3.0) * mu + d;
  const T other = abs(bulk * theta2 - (2.0 / 3.0) * mu) + d;
  const T stretch = max(own - other, T{}) * n.largest + other * n.trace;
  const T shear = max(mu, abs(mu - 0.5 * bulk * (theta2 - 1.0))) + d;
  return max(stretch, shear * n.largest_two);
}

template <class T>
T joint_bound(T uniform, T hourglass, double overlap) {
  const T half = 0.5 * (uniform - hourglass);
  return 0.5 * (uniform + hourglass) + sqrt(fma(half, half, uniform * hourglass * overlap));
}

// `f`: mean deformation gradient.
template <class T>
T frequency_bound(const Shape::Element& element, const Matrix3<T>& f, T bulk, T mu, T stress) {
  const auto adj = adjugate(f);
  const T j = determinant(f, adj);
  const auto n = eigenvalue_bounds(pushed_spread(adj, j, element.spread));
  const T uniform = uniform_bound(n, bulk, mu, j, j * stress / mu);
  const auto inverse = eigenvalue_bounds(pushed_spread(adj, j, {1, 1, 1, 0, 0, 0}));
  const auto moduli = hourglass_moduli(mu, bulk);
  const T hourglass = max(moduli.plate, moduli.shear) * inverse.largest * element.hourglass_spread;
  return joint_bound(uniform, hourglass, element.overlap);
}

}  // namespace pulvis::space::kernels
