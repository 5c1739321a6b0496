// Bulk damping of a quad: stresses proportional to the strain rate (the stiffness-proportional part of
// Rayleigh damping; the mass-proportional part is -alpha m v on every node).
//
// Source   Rayleigh (1877); as a viscous stress on the rate of deformation: Abaqus' *DAMPING, BETA.
//          Rates at mid-step: Hughes & Winget (1980)
// Symbols  A, a b h   map of the element, systems/body/element_kernel.hpp; dotted: the map of its nodal velocities
//          D          sym(dv/dx) [1/s];  J = det F, theta its mean over the element [-]
//          beta       stiffness-proportional damping [s]
// Law      beta times the rate of the elastic stress at small distortion, regardless of plastic flow:
//            s = beta 2 mu/J dev D,   p = beta K/2 (theta + 1/theta) tr D,   M = beta E' d(kappa)/dt
//          so that a small oscillation of angular frequency omega decays with damping ratio beta omega/2 in
//          every formulation
// Valid    the velocities are those of the step that led here. Strain rates are evaluated at the positions
//          half a step back, where a rigid rotation, however large, gives none; the stresses act at the
//          current positions, so that they exert no moment
#pragma once

#include "systems/body/hourglass_kernel.hpp"

namespace pulvis::kernels {

template <class T>
struct StrainRate {
  T xx, yy, xy;  // 1/s
  T trace() const { return xx + yy; }
};

// D = sym(A' A^-1).
template <class T>
StrainRate<T> strain_rate(const Matrix2<T>& a, const Matrix2<T>& rate) {
  const T over = 1.0 / determinant(a);
  return {over * (rate.xx * a.yy - rate.xy * a.yx), over * (rate.yy * a.xx - rate.yx * a.xy),
          0.5 * over * (rate.xy * a.xx - rate.xx * a.xy + rate.yx * a.yy - rate.yy * a.yx)};
}

template <class T>
struct ViscousStress {
  T xx, yy, xy;  // Pa
};

// `shear` = beta 2 mu/J, `bulk` = beta K/2 (theta + 1/theta); `dilatation` = tr D, or its mean over the element.
template <class T>
ViscousStress<T> viscous_stress(const StrainRate<T>& d, T dilatation, T shear, T bulk) {
  const T third = (1.0 / 3.0) * d.trace(), mean = bulk * dilatation;
  return {shear * (d.xx - third) + mean, shear * (d.yy - third) + mean, shear * d.xy};
}

template <class T>
T viscous_bulk_modulus(T bulk, T theta) {
  return 0.5 * bulk * (theta + 1.0 / theta);
}

// Rates of the natural components w of h: dw = A^-1 (dh - w_1 da - w_2 db). Zero for a rigid rotation.
template <class T>
Hourglass<T> hourglass_rate(const QuadMap<T>& m, const QuadMap<T>& rate) {
  const T over = 1.0 / (m.ax * m.by - m.bx * m.ay);
  const Hourglass<T> w = natural_hourglass(m, over);
  const T x = rate.hx - w.one * rate.ax - w.two * rate.bx;
  const T y = rate.hy - w.one * rate.ay - w.two * rate.by;
  return {over * (x * m.by - y * m.bx), over * (m.ax * y - m.ay * x)};
}

}  // namespace pulvis::kernels
