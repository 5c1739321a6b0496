// Highest squared frequency of a quad in its uniform-strain modes, exact for elastic moduli that are
// isotropic or nearly so; the hourglass modes of the four-point element are lower.
//
// With lumped masses m_I = rho a_I t at the corners and uniform gradients b_I = G^T dN_I/dxi
// (G = dxi/dx), the modes are those of the 4x4 problem C : H over (sum_I b_I b_I^T / m_I)^-1. In the axes
// of N = V sum_I b_I b_I^T / a_I [1/m^2], n_1 and n_2 its eigenvalues, it splits into two 2x2 blocks:
//   stretches (h_11, h_22):  [[M n_1, L s], [L s, M n_2]],  s = sqrt(n_1 n_2)
//   shears    (h_12, h_21):  [[m n_2, l s], [l s, m n_1]]
// Moduli per undeformed volume of U = K/2 ((theta^2 - 1)/2 - ln theta) and the neo-Hookean deviator:
//   M = K (1 + theta^2)/2 + 4/3 mu + d,   L = |K theta^2 - 2/3 mu| + d
//   m = mu + d,                            l = |mu - K (theta^2 - 1)/2| + d
// d bounds the effect of elastic distortion: for b' (isochoric elastic left Cauchy-Green, det 1) the acoustic
// tensor grows by at most 1.15 |dev b'| mu.
#pragma once

#include <cmath>

#include "components/shape.hpp"
#include "engine/lane.hpp"
#include "systems/body/element_kernel.hpp"

namespace pulvis::kernels {

// Trace and determinant of N = G^T D G for the map A = dx/dxi.
template <class T>
struct ModeSpread {
  T trace, det;  // 1/m^2, 1/m^4
};
template <class T>
ModeSpread<T> mode_spread(const Matrix2<T>& a, const Shape::CornerMoment& d) {
  const T over = 1.0 / determinant(a);
  const T over2 = over * over;
  // G = [[a.yy, -a.xy], [-a.yx, a.xx]] / det a
  const T nxx =
      (d.xixi * a.yy * a.yy - 2.0 * d.xieta * a.yy * a.yx + d.etaeta * a.yx * a.yx) * over2;
  const T nyy =
      (d.xixi * a.xy * a.xy - 2.0 * d.xieta * a.xy * a.xx + d.etaeta * a.xx * a.xx) * over2;
  return {nxx + nyy, (d.xixi * d.etaeta - d.xieta * d.xieta) * over2};
}

// Larger eigenvalue of [[p n_1, q s], [q s, p n_2]].
template <class T>
T block_frequency(const ModeSpread<T>& n, T p, T q) {
  const T half = 0.5 * n.trace;
  return p * half + sqrt(p * p * max(half * half - n.det, T{}) + q * q * n.det);
}

// rho omega^2, Pa/m^2. `distortion` = |dev b'|, the norm of the deviatoric Kirchhoff stress over mu.
template <class T>
T frequency_bound(const ModeSpread<T>& n, T bulk, T mu, T theta, T distortion) {
  const T theta2 = theta * theta;
  const T d = 1.15 * (distortion * mu);
  const T tau = 0.5 * bulk * (theta2 - 1.0);
  const T stretch = block_frequency<T>(n, 0.5 * bulk * (1.0 + theta2) + (4.0 / 3.0) * mu + d,
                                       abs(bulk * theta2 - (2.0 / 3.0) * mu) + d);
  const T shear = block_frequency<T>(n, mu + d, abs(mu - tau) + d);
  return max(stretch, shear);
}

// Stable leapfrog step for a mode whose damping -alpha v - beta omega^2 v uses the velocity half a step
// back: 2/omega (sqrt(1 + xi^2) - xi), xi = alpha/(2 omega) + beta omega/2. Decreases with omega.
template <class T>
T damped_step(T omega2, T alpha, T beta) {
  const T decay = 0.5 * (alpha + beta * omega2);  // xi omega
  return 2.0 / (decay + sqrt(omega2 + decay * decay));
}

// Largest eigenvalue of the spring matrix L/6 [[2,1],[1,2]] of an edge over its nodal areas a and b: m^-1.
inline double edge_spring_frequency(double length, double a, double b) {
  const double p = 1 / a, q = 1 / b;
  return length / 6 * (p + q + std::sqrt((p - q) * (p - q) + p * q));
}

}  // namespace pulvis::kernels
