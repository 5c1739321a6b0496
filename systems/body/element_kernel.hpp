// Kinematics of the four-node plane-strain quad with 2x2 Gauss points and mean dilatation.
//
// Source   Simo, Taylor & Pister (1985); Hughes (1980) for the mean-dilatation idea; explicit use as in
//          Belytschko, Liu & Moran (2000), ch. 8
// Symbols  X, x   undeformed, current position [m];  (xi, eta) in [-1,1]^2
//          A      dx/d(xi,eta) at a point [m]
//          F      deformation gradient dx/dX [-], plane strain: F_zz = 1
//          J      det F [-];  theta = current / undeformed area of the element [-]
// All functions work on values, for T = double or Lane.
#pragma once

#include "engine/lane.hpp"
#include "engine/portable_math.hpp"

namespace pulvis::kernels {

inline constexpr double gauss = 0.57735026918962576451;  // 1/sqrt 3
inline constexpr double gauss_xi[4] = {-gauss, gauss, gauss, -gauss};
inline constexpr double gauss_eta[4] = {-gauss, -gauss, gauss, gauss};

template <class T>
struct Matrix2 {
  T xx, xy, yx, yy;
};

template <class T>
T determinant(const Matrix2<T>& m) {
  return fma(m.xx, m.yy, -(m.xy * m.yx));
}

// x(xi, eta) = centre + a xi + b eta + h xi eta: the isoparametric map without its constant, times Scale.
template <class T, int Scale = 1>
struct QuadMap {
  T ax, ay, bx, by, hx, hy;
};
// Four times the map: plain sums of coordinates. Scale-invariant functions give the same result.
template <class T>
using FourfoldMap = QuadMap<T, 4>;

template <class T>
FourfoldMap<T> fourfold_map(T x0, T y0, T x1, T y1, T x2, T y2, T x3, T y3) {
  const T sx = x2 - x0, dx = x1 - x3, sy = y2 - y0, dy = y1 - y3;
  return {sx + dx, sy + dy, sx - dx, sy - dy, (x0 - x1) + (x2 - x3), (y0 - y1) + (y2 - y3)};
}
template <class T>
QuadMap<T> quad_map(T x0, T y0, T x1, T y1, T x2, T y2, T x3, T y3) {
  const auto m = fourfold_map(x0, y0, x1, y1, x2, y2, x3, y3);
  return {0.25 * m.ax, 0.25 * m.ay, 0.25 * m.bx, 0.25 * m.by, 0.25 * m.hx, 0.25 * m.hy};
}

// A = [dx/dxi dx/deta; dy/dxi dy/deta]
template <class T, int Scale>
Matrix2<T> map_gradient(const QuadMap<T, Scale>& m, double xi, double eta) {
  return {fma(eta, m.hx, m.ax), fma(xi, m.hx, m.bx), fma(eta, m.hy, m.ay), fma(xi, m.hy, m.by)};
}

// F = A d(xi,eta)/dX; `inverse` = xi_X, xi_Y, eta_X, eta_Y of the undeformed element.
template <class T, class Inverse>
Matrix2<T> deformation_gradient(const Matrix2<T>& a, const Inverse& inverse) {
  return {fma(a.xx, inverse[0], a.xy * inverse[2]), fma(a.xx, inverse[1], a.xy * inverse[3]),
          fma(a.yx, inverse[0], a.yy * inverse[2]), fma(a.yx, inverse[1], a.yy * inverse[3])};
}

// Nodal forces of a quad, accumulated as their moments with 1, xi and eta; see add_flux, node_force.
template <class T>
struct QuadFlux {
  T xi_x{}, xi_y{}, eta_x{}, eta_y{}, h_x{}, h_y{};
};

// Adds the Kirchhoff-like stress sigma (xx yy xy) at a Gauss point of a slice of depth `thickness`.
// With F = A (dX/dxi)^-1, P dN/dX dV0 collapses to sigma cof(A) dN/dxi: no undeformed geometry is needed.
template <class T>
void add_flux(QuadFlux<T>& flux, const Matrix2<T>& a, T sxx, T syy, T sxy, double xi, double eta) {
  const T qxi_x = fma(sxx, a.yy, -(sxy * a.xy)), qxi_y = fma(sxy, a.yy, -(syy * a.xy));
  const T qeta_x = fma(sxy, a.xx, -(sxx * a.yx)), qeta_y = fma(syy, a.xx, -(sxy * a.yx));
  flux.xi_x += qxi_x;
  flux.xi_y += qxi_y;
  flux.eta_x += qeta_x;
  flux.eta_y += qeta_y;
  flux.h_x = fma(eta, qxi_x, fma(xi, qeta_x, flux.h_x));
  flux.h_y = fma(eta, qxi_y, fma(xi, qeta_y, flux.h_y));
}

// The same for a stress at the centre only: no moment with xi eta.
template <class T>
QuadFlux<T> central_flux(const Matrix2<T>& a, T sxx, T syy, T sxy) {
  return {fma(sxx, a.yy, -(sxy * a.xy)),
          fma(sxy, a.yy, -(syy * a.xy)),
          fma(sxy, a.xx, -(sxx * a.yx)),
          fma(syy, a.xx, -(sxy * a.yx)),
          T{},
          T{}};
}

// Force of the stresses on node I of the quad: -sum_g (sigma cof A) dN_I/dxi; factor = thickness / 4.
template <class T>
struct QuadForce {
  T x[4], y[4];
};
template <class T>
QuadForce<T> node_forces(const QuadFlux<T>& q, double factor) {
  const T px = factor * (q.xi_x + q.eta_x), mx = factor * (q.xi_x - q.eta_x), hx = factor * q.h_x;
  const T py = factor * (q.xi_y + q.eta_y), my = factor * (q.xi_y - q.eta_y), hy = factor * q.h_y;
  // dN_I/dxi = (xi_I + xi_I eta_I eta)/4: nodes (-,-) (+,-) (+,+) (-,+)
  return {{px - hx, hx - mx, -px - hx, mx + hx}, {py - hy, hy - my, -py - hy, my + hy}};
}

// a^(-1/3). Near one, the usual range of det F, without division: a polynomial and a third-order step.
// Lanes outside that range are handled one by one, so that no lane depends on its neighbours.
template <class T>
T refine_inverse_cube_root(T a, T y) {
  const T h = fma(-(a * y), y * y, 1.0);
  return fma(y * h, fma(0.22222222222222222, h, 0.33333333333333333), y);
}

inline double wide_inverse_cube_root(double a) {
  if (!(a > 0.5 && a < 2)) return 1 / portable::cbrt(a);
  const double x = a - 1.25;  // minimax relative error of degree 4: 1.1e-3
  const double y =
      0.92867438 + x * (-0.24146973 + x * (0.12257569 + x * (-0.12062945 + x * 0.09144541)));
  return refine_inverse_cube_root(a, refine_inverse_cube_root(a, y));
}
[[gnu::noinline]] inline double replace_far(double a, double y) {
  return a > 0.8 && a < 1.25 ? y : wide_inverse_cube_root(a);
}
template <std::size_t Registers>
[[gnu::noinline]] Pack<Registers> replace_far(Pack<Registers> a, Pack<Registers> y) {
  for (int l = 0; l < static_cast<int>(a.size); ++l) y[l] = replace_far(a[l], y[l]);
  return y;
}

template <class T>
T inverse_cube_root(T a) {
  const T x = a - 1.025, x2 = x * x;  // minimax relative error of degree 5 on [0.8, 1.25]: 4.3e-7
  const T y = fma(
      x2, fma(x2, fma(-0.117564949399, x, 0.136975824411), fma(-0.158961779405, x, 0.209634704292)),
      fma(-0.322539066518, x, 0.991803323496));
  const T near = refine_inverse_cube_root(a, y);
  if (!all((a > 0.8) & (a < 1.25))) return replace_far(a, near);
  return near;
}

}  // namespace pulvis::kernels
