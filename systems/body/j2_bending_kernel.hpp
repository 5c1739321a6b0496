// Plastic bending of the one-point element: the stress of its hourglass modes shares one yield surface with the
// deviator at its centre; both are returned together by systems/body/j2_kernel.hpp.
//
// Source   plastic moment of a rectangular section combined with the centre stress; yield surface as in Ilyushin (1948)
//          for plates
// Symbols  those of systems/body/hourglass_kernel.hpp
#pragma once

#include "systems/body/hourglass_kernel.hpp"

namespace pulvis::kernels {

// The minimum share of its limit that bending keeps under fully plastic stretching, where it should keep
// none. With less, the return of stresses that barely leave the surface amplifies round-off: two runs of
// 7,000 steps that differ by 1e-14 diverge to 9e-6 with 0.1, 1e-8 with 0.3, 2e-11 with 0.5. The force of the
// unit cell (140 quads) drops by 0.6% from 0.1 to 0.5 (docs/accuracy.md).
inline constexpr double min_width = 0.5;

// Squared part of a deviator that stretches the fibres (and shortens the transverse direction), as numerator
// and denominator: s:N with N = (e e - e' e')/sqrt 2. e: the direction of a, which in a rectangle is that
// of b rotated back by a right angle; otherwise that of the sum of the two.
template <class T>
struct Ratio {
  T numerator, denominator;
};
template <class T, int Scale>
Ratio<T> squared_stretching(const QuadMap<T, Scale>& m, const Deviator<T>& s) {
  const T x = m.ax + m.by, y = m.ay - m.bx;
  const T xx = x * x, yy = y * y, length2 = xx + yy;
  // e with its angle doubled is (x^2 - y^2, 2 x y) / length2.
  const T stretch = fma(0.5 * (s.xx - s.yy), xx - yy, s.xy * (2.0 * x * y));
  return {2.0 * stretch * stretch, length2 * length2};
}

// 1/width: see CoupledBending; with s after its return to the surface. `limit2`: 2/3 sigma_y^2.
template <class T, int Scale>
T inverse_width(const QuadMap<T, Scale>& m, const Deviator<T>& s, T limit2) {
  const auto stretching = squared_stretching(m, s);
  const T norm2 = squared_norm(s);
  const T full = stretching.denominator * max(norm2, limit2);
  const T room = fma((-4.0 / 3.0), stretching.numerator,
                     fma((1.0 / 3.0) * norm2, stretching.denominator, full));
  return full / max(room, min_width * full);
}

// The bending stress coupled with a deviator under the joint yield surface
//   |s|^2 + t^2/width <= 2/3 sigma_y^2,   t^2 = 2/9 (M_1^2 + M_2^2),
//   width = 1 - n_f^2 + n_s^2/3,  n = s / (sqrt(2/3) sigma_y), n_f the part along the fibres, n_s the rest.
// The exact capacity of a fibre section in three limits: M = M_p without s; M = M_p (1 - n_f^2) with
// stretching; and small bending in fully plastic shear. In between it is accurate to 1%. The work of t has
// compliance 1/(2/3 E'), that of s has 1/(2 mu); both flow along s and t/width.
template <class T>
struct CoupledBending {
  Hourglass<T> stress;  // trial
  T softness;           // 2/3 E' / (2 mu): how much faster than s it relaxes
  T stiffness;          // 1 / softness
  T inv_width;
  T retained;  // share of the stress that remains after the return

  T squared_norm() const {
    return (2.0 / 9.0) * fma(stress.one, stress.one, stress.two * stress.two);
  }
  T joint_norm(T norm2) const { return fma(inv_width, squared_norm(), norm2); }
  // Slope of the consistency condition and the excess stress, both times |S|^2.
  T slope(T norm2, T joint2, T, T modulus, T two_mu) const {
    const T flow = inv_width * inv_width * squared_norm();
    return fma((2.0 / 3.0) * joint2, modulus, two_mu * fma(softness, flow, norm2));
  }
  T push(T excess, T norm) const { return excess * norm; }

  // For nonlinear laws the return iterates on the joint surface itself.
  T farthest(T two_mu) const { return max(stiffness / inv_width, T{} + 1.0) / two_mu; }
  Remaining<T> keep(T beta, const Trial<T>& t) {
    const T kept = max(beta, T{}), t2 = squared_norm();
    retained = max(fma(softness * inv_width, beta - 1.0, 1.0), T{});
    const T size = sqrt(fma(kept * kept, t.norm2, inv_width * (retained * retained * t2)));
    const T flow = softness * inv_width * inv_width * (retained * t2);
    return {size, -(t.two_mu_bar / size) * fma(kept, t.norm2, flow)};
  }

  // The linear step leaves stresses outside the surface where the stretching is large compared to the elastic
  // strain: where the excess is more than 1e-4 (of the squares), both are scaled straight back. The work
  // dissipated is then that of the retained stresses.
  template <class Mask, class Hardening>
  void settle(const Mask& flows, T& beta, T& dgamma, T norm2, T two_mu, T eps,
              const Hardening& law) {
    const T t2 = squared_norm();
    retained = max(fma(softness * inv_width, beta - 1.0, 1.0), T{});
    const T outside = fma(beta * beta, norm2, inv_width * (retained * retained * t2));
    const T limit = sqrt_2_3 * law.flow_stress(fma(sqrt_2_3, dgamma, eps));
    const auto beyond = flows & (outside > (1 + 1e-4) * (limit * limit));
    if (!any(beyond)) return;
    const T root = sqrt(outside), cost = two_mu * limit;
    const T over = 1.0 / (root * cost);  // one division instead of two
    const T in = select(beyond, limit * cost * over, T{} + 1.0);
    beta *= in;
    retained *= in;
    const T spent = fma(beta * (1.0 - beta), norm2, retained * (1.0 - retained) * (t2 * stiffness));
    dgamma = select(beyond, spent * (root * over), dgamma);
  }
};

// Whether s and t can yield at all, for any width: the width is never below 1 - |n|^2.
template <class T>
auto may_yield(const Deviator<T>& s, const Hourglass<T>& m, T limit2) {
  const T room = limit2 - squared_norm(s);
  const T bending2 = (2.0 / 9.0) * fma(m.one, m.one, m.two * m.two);
  return (room < T{}) | (room * room < bending2 * limit2);
}

}  // namespace pulvis::kernels
