// The two modes that the one-point quad cannot see at its centre: bending of the fibres along xi and of
// the fibres along eta. Physical stabilisation: elastic-plastic bending with the actual material constants.
//
// Source   Modes: Flanagan & Belytschko (1981). Bending stiffness: assumed stress of Pian & Sumihara
//          (1984), which is the assumed strain of Belytschko & Bindeman (1991) on rectangles: uniaxial
//          stress along the fibres, linear across them, no shear; valid for nu -> 1/2 too. Limit:
//          systems/body/j2_bending_kernel.hpp.
// Symbols  x = centre + a xi + b eta + h xi eta, A = [a b];  w = A^-1 h, natural components of h [-];
//          w_0 that of the undeformed element: w - w_0 is zero for every homogeneous deformation, and
//          invariant to rotation
//          kappa  strain of the outermost fibre [-]: kappa_1 = (w - w_0)_1 + skew_1 (w - w_0)_2 along xi
//                 (a.h/a.a where only h changes), kappa_2 the same along eta; kappa_p its plastic part
//          M      stress of the outermost fibre if it were linear across the element [Pa] = E' (kappa -
//                 kappa_p);  E' = E/(1 - nu^2).  M_p = 3/2 * 2/sqrt 3 sigma_y = sqrt 3 sigma_y
// Energy   per undeformed area: (M_1^2 + M_2^2) / (6 E')
// Valid    elements that are not inverted; M is treated as a Cauchy stress, which is accurate to
//          within theta - 1 (one percent in metals)
#pragma once

#include <array>

#include "systems/body/j2_kernel.hpp"

namespace pulvis::kernels {

template <class T>
struct Hourglass {  // of the fibres along xi, along eta
  T one, two;
};

// w = A^-1 h; inv_det = 1 / det A.
template <class T, int Scale>
Hourglass<T> natural_hourglass(const QuadMap<T, Scale>& m, T inv_det) {
  return {inv_det * fma(m.hx, m.by, -(m.hy * m.bx)), inv_det * fma(m.ax, m.hy, -(m.ay * m.hx))};
}

template <class T, class Reference>  // Shape::Hourglass
Hourglass<T> bending_strain(const Hourglass<T>& w, const Reference& reference) {
  const T one = w.one - reference.natural[0], two = w.two - reference.natural[1];
  return {fma(reference.skew[0], two, one), fma(reference.skew[1], one, two)};
}

// det A at the Gauss points of the four-point element, relative to the centre: A = [a + eta h, b +
// xi h], so 1 + xi w_2 + eta w_1.
template <class T>
std::array<T, 4> corner_determinants(const Hourglass<T>& w) {
  const T even = gauss * (w.one + w.two), odd = gauss * (w.one - w.two);
  return {1.0 - even, 1.0 - odd, 1.0 + even, 1.0 + odd};
}

// det F there over theta; 1 for every homogeneous deformation.
template <class T, class Reference>
std::array<T, 4> corner_ratios(const Hourglass<T>& w, const Reference& reference) {
  auto ratio = corner_determinants(w);
  for (std::size_t k = 0; k < 4; ++k) ratio[k] *= reference.inv_determinant[k];
  return ratio;
}
template <class T>
T min_ratio(const std::array<T, 4>& ratio) {
  return min(min(ratio[0], ratio[1]), min(ratio[2], ratio[3]));
}

// Plastic bending does not stop a corner from folding, as the four points of the other elements do, whose
// isochoric stretch grows without bound there. So a corner with a ratio r below `barrier_ratio` stores
// mu/8 (r + barrier_ratio^2/r - 2 barrier_ratio) per undeformed area, which grows without bound too.
inline constexpr double barrier_ratio = 0.3;

template <class T>
T inversion_barrier_energy(const std::array<T, 4>& ratio, T mu) {
  T sum{};
  for (const T& r : ratio)
    sum +=
        select(r < barrier_ratio, r + barrier_ratio * barrier_ratio / r - 2 * barrier_ratio, T{});
  return (1.0 / 8.0) * mu * sum;
}
// Its derivative with respect to w.
template <class T, class Reference>
Hourglass<T> inversion_barrier_moment(const std::array<T, 4>& ratio, const Reference& reference,
                                      T mu) {
  std::array<T, 4> slope;
  for (std::size_t k = 0; k < 4; ++k)
    slope[k] = reference.inv_determinant[k] *
               min(1.0 - barrier_ratio * barrier_ratio / (ratio[k] * ratio[k]), T{});
  const T scale = (1.0 / 8.0 * gauss) * mu, even = slope[2] - slope[0], odd = slope[3] - slope[1];
  return {scale * (even + odd), scale * (even - odd)};
}

// E' = E/(1 - nu^2).
template <class T>
T plane_strain_modulus(T mu, T bulk) {
  return 4.0 * mu * (3.0 * bulk + mu) / (3.0 * bulk + 4.0 * mu);
}

// Stored energy per undeformed area.
template <class T>
T hourglass_energy(const Hourglass<T>& stress, T modulus) {
  return fma(stress.one, stress.one, stress.two * stress.two) / (6.0 * modulus);
}

// Exact derivative of the stored energy: d(w) = A^-1 (dh - w_1 da - w_2 db). `third`: one third of the
// undeformed area, which is the integral of xi^2.
template <class T, class Reference>
Hourglass<T> bending_moment(const Hourglass<T>& stress, const Reference& reference, double third) {
  return {third * fma(reference.skew[1], stress.two, stress.one),
          third * fma(reference.skew[0], stress.one, stress.two)};
}
template <class T, int Scale>
void add_hourglass_flux(QuadFlux<T>& flux, const QuadMap<T, Scale>& m, const Hourglass<T>& w,
                        T inv_det, const Hourglass<T>& moment) {
  const T one = inv_det * moment.one, two = inv_det * moment.two;
  const T qx = fma(m.by, one, -(m.ay * two)), qy = fma(m.ax, two, -(m.bx * one));
  flux.h_x += qx;
  flux.h_y += qy;
  flux.xi_x = fma(-w.one, qx, flux.xi_x);
  flux.xi_y = fma(-w.one, qy, flux.xi_y);
  flux.eta_x = fma(-w.two, qx, flux.eta_x);
  flux.eta_y = fma(-w.two, qy, flux.eta_y);
}

}  // namespace pulvis::kernels
