// The two modes that the one-point quad cannot see at its centre: bending of the fibres along xi and of
// the fibres along eta. Physical stabilisation: elastic-plastic bending with the material's own constants.
//
// Source   Modes: Flanagan & Belytschko (1981). Bending stiffness: assumed stress of Pian & Sumihara
//          (1984), which is the assumed strain of Belytschko & Bindeman (1991) on rectangles: uniaxial
//          stress along the fibres, linear across them, no shear; right for nu -> 1/2 too. Limit:
//          plastic moment of a rectangular section beside the centre's stress, a yield surface as
//          Ilyushin's (1948) for plates; see BendingBeside.
// Symbols  x = centre + a xi + b eta + h xi eta, A = [a b];  w = A^-1 h, natural components of h [-];
//          w_0 those of the undeformed element: w - w_0 is zero in every homogeneous deformation, and
//          blind to rotation
//          kappa  strain of the outermost fibre [-]: kappa_1 = (w - w_0)_1 + skew_1 (w - w_0)_2 along xi
//                 (a.h/a.a where nothing but h moves), kappa_2 the same along eta; kappa_p its plastic part
//          M      stress of the outermost fibre if it were linear across the element [Pa] = E' (kappa -
//                 kappa_p);  E' = E/(1 - nu^2).  M_p = 3/2 * 2/sqrt 3 sigma_y = sqrt 3 sigma_y
// Energy   per undeformed area: (M_1^2 + M_2^2) / (6 E')
// Valid    elements that are not turned inside out; M is taken for a Cauchy stress, which is right to
//          within theta - 1 (a percent in metals)
#pragma once

#include <array>

#include "systems/body/j2_kernel.hpp"

namespace pulvis::kernels {

// The least share of its limit that bending keeps beside fully plastic stretching, where it should have
// none. With less, the return of stresses that hardly leave the surface amplifies round-off: two runs of
// 7,000 steps that differ by 1e-14 part to 9e-6 with 0.1, 1e-8 with 0.3, 2e-11 with 0.5. The force of the
// unit cell (140 quads) falls by 0.6% from 0.1 to 0.5 (docs/accuracy.md).
inline constexpr double least_width = 0.5;

template <class T>
struct Hourglass {  // of the fibres along xi, along eta
  T one, two;
};

// w = A^-1 h; over_det = 1 / det A.
template <class T>
Hourglass<T> natural_hourglass(const QuadMap<T>& m, T over_det) {
  return {over_det * fma(m.hx, m.by, -(m.hy * m.bx)), over_det * fma(m.ax, m.hy, -(m.ay * m.hx))};
}

template <class T, class Reference>  // Shape::Hourglass
Hourglass<T> bending_strain(const Hourglass<T>& w, const Reference& reference) {
  const T one = w.one - reference.natural[0], two = w.two - reference.natural[1];
  return {fma(reference.skew[0], two, one), fma(reference.skew[1], one, two)};
}

// det A at the four Gauss points of the element with four, over that at the middle: A = [a + eta h, b +
// xi h], so 1 + xi w_2 + eta w_1.
template <class T>
std::array<T, 4> corner_determinants(const Hourglass<T>& w) {
  const T even = gauss * (w.one + w.two), odd = gauss * (w.one - w.two);
  return {1.0 - even, 1.0 - odd, 1.0 + even, 1.0 + odd};
}

// det F there over theta; 1 in every homogeneous deformation.
template <class T, class Reference>
std::array<T, 4> corner_ratios(const Hourglass<T>& w, const Reference& reference) {
  auto ratio = corner_determinants(w);
  for (std::size_t k = 0; k < 4; ++k) ratio[k] *= reference.over_determinant[k];
  return ratio;
}
template <class T>
T least_ratio(const std::array<T, 4>& ratio) {
  return min(min(ratio[0], ratio[1]), min(ratio[2], ratio[3]));
}

// Bending that flows does not keep a corner from folding, as the four points of the other elements do,
// whose isochoric stretch grows without bound there. So a corner with a ratio r below `folding` stores
// mu/8 (r + folding^2/r - 2 folding) per undeformed area, which grows without bound too.
inline constexpr double folding = 0.3;

template <class T>
T folding_energy(const std::array<T, 4>& ratio, T mu) {
  T sum{};
  for (const T& r : ratio) sum += select(r < folding, r + folding * folding / r - 2 * folding, T{});
  return (1.0 / 8.0) * mu * sum;
}
// Its derivative by w.
template <class T, class Reference>
Hourglass<T> folding_moment(const std::array<T, 4>& ratio, const Reference& reference, T mu) {
  std::array<T, 4> slope;
  for (std::size_t k = 0; k < 4; ++k)
    slope[k] =
        reference.over_determinant[k] * min(1.0 - folding * folding / (ratio[k] * ratio[k]), T{});
  const T scale = (1.0 / 8.0 * gauss) * mu, even = slope[2] - slope[0], odd = slope[3] - slope[1];
  return {scale * (even + odd), scale * (even - odd)};
}

// E' = E/(1 - nu^2).
template <class T>
T plane_strain_modulus(T mu, T bulk) {
  return 4.0 * mu * (3.0 * bulk + mu) / (3.0 * bulk + 4.0 * mu);
}

// Stored, per undeformed area.
template <class T>
T hourglass_energy(const Hourglass<T>& stress, T modulus) {
  return fma(stress.one, stress.one, stress.two * stress.two) / (6.0 * modulus);
}

// Exact derivative of the stored energy: d(w) = A^-1 (dh - w_1 da - w_2 db). `third`: a third of the
// undeformed area, which is the integral of xi^2.
template <class T, class Reference>
Hourglass<T> bending_moment(const Hourglass<T>& stress, const Reference& reference, double third) {
  return {third * fma(reference.skew[1], stress.two, stress.one),
          third * fma(reference.skew[0], stress.one, stress.two)};
}
template <class T>
void add_hourglass_flux(QuadFlux<T>& flux, const QuadMap<T>& m, const Hourglass<T>& w, T over_det,
                        const Hourglass<T>& moment) {
  const T one = over_det * moment.one, two = over_det * moment.two;
  const T qx = fma(m.by, one, -(m.ay * two)), qy = fma(m.ax, two, -(m.bx * one));
  flux.h_x += qx;
  flux.h_y += qy;
  flux.xi_x = fma(-w.one, qx, flux.xi_x);
  flux.xi_y = fma(-w.one, qy, flux.xi_y);
  flux.eta_x = fma(-w.two, qx, flux.eta_x);
  flux.eta_y = fma(-w.two, qy, flux.eta_y);
}

// Squared part of a deviator that stretches the fibres (and shortens what lies across them), as numerator
// and denominator: s:N with N = (e e - e' e')/sqrt 2. e: the direction of a, which in a rectangle is that
// of b turned back by a right angle; in others, that of the sum of both.
template <class T>
struct Ratio {
  T numerator, denominator;
};
template <class T>
Ratio<T> squared_stretching(const QuadMap<T>& m, const Deviator<T>& s) {
  const T x = m.ax + m.by, y = m.ay - m.bx;
  const T xx = x * x, yy = y * y, length2 = xx + yy;
  // e with its angle doubled is (x^2 - y^2, 2 x y) / length2.
  const T stretch = fma(0.5 * (s.xx - s.yy), xx - yy, s.xy * (2.0 * x * y));
  return {2.0 * stretch * stretch, length2 * length2};
}

// 1/width: see BendingBeside; with s where it has come back to the surface. `limit2`: 2/3 sigma_y^2.
template <class T>
T inverse_width(const QuadMap<T>& m, const Deviator<T>& s, T limit2) {
  const auto stretching = squared_stretching(m, s);
  const T norm2 = squared_norm(s);
  const T full = stretching.denominator * max(norm2, limit2);
  const T room = fma((-4.0 / 3.0), stretching.numerator,
                     fma((1.0 / 3.0) * norm2, stretching.denominator, full));
  return full / max(room, least_width * full);
}

// The bending stress beside a deviator under the joint yield surface
//   |s|^2 + t^2/width <= 2/3 sigma_y^2,   t^2 = 2/9 (M_1^2 + M_2^2),
//   width = 1 - n_f^2 + n_s^2/3,  n = s / (sqrt(2/3) sigma_y), n_f the part along the fibres, n_s the rest.
// What a fibre section bears exactly in three limits: M = M_p without s; M = M_p (1 - n_f^2) with
// stretching; and small bending in fully plastic shear. Between them it is right to 1%. The work of t has
// the compliance 1/(2/3 E'), where that of s has 1/(2 mu); both flow along s and t/width.
template <class T>
struct BendingBeside {
  Hourglass<T> stress;  // trial
  T softness;           // 2/3 E' / (2 mu): how much faster than s it gives way
  T stiffness;          // 1 / softness
  T over_width;
  T left;  // share of the stress that the return leaves

  T squared_norm() const {
    return (2.0 / 9.0) * fma(stress.one, stress.one, stress.two * stress.two);
  }
  T joint_norm(T norm2) const { return fma(over_width, squared_norm(), norm2); }
  // Slope of the consistency condition and the excess, both times |S|^2.
  T slope(T norm2, T joint2, T, T modulus, T two_mu) const {
    const T flow = over_width * over_width * squared_norm();
    return fma((2.0 / 3.0) * joint2, modulus, two_mu * fma(softness, flow, norm2));
  }
  T push(T excess, T norm) const { return excess * norm; }
  // The linear step leaves stresses outside the surface where the stretching is large against the elastic
  // strain: where it is by more than a ten-thousandth (of the squares), both are pulled straight in. The
  // work that is spent then is that of the stresses left.
  template <class Mask, class Hardening>
  void settle(const Mask& flows, T& beta, T& dgamma, T norm2, T two_mu, T eps,
              const Hardening& law) {
    constexpr double sqrt_2_3 = 0.81649658092772603273;
    const T t2 = squared_norm();
    left = max(fma(softness * over_width, beta - 1.0, 1.0), T{});
    const T outside = fma(beta * beta, norm2, over_width * (left * left * t2));
    const T limit = sqrt_2_3 * law.flow_stress(fma(sqrt_2_3, dgamma, eps));
    const auto beyond = flows & (outside > (1 + 1e-4) * (limit * limit));
    if (!any(beyond)) return;
    const T root = sqrt(outside), cost = two_mu * limit;
    const T over = 1.0 / (root * cost);  // one division for two
    const T in = select(beyond, limit * cost * over, T{} + 1.0);
    beta *= in;
    left *= in;
    const T spent = fma(beta * (1.0 - beta), norm2, left * (1.0 - left) * (t2 * stiffness));
    dgamma = select(beyond, spent * (root * over), dgamma);
  }
};

// Whether s and t can yield at all, whatever the width: it is never below 1 - |n|^2.
template <class T>
auto may_yield(const Deviator<T>& s, const Hourglass<T>& m, T limit2) {
  const T left = limit2 - squared_norm(s);
  const T bending2 = (2.0 / 9.0) * fma(m.one, m.one, m.two * m.two);
  return (left < T{}) | (left * left < bending2 * limit2);
}

}  // namespace pulvis::kernels
