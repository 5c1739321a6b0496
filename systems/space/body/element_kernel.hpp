// Kinematics of the 8-node hexahedron in terms of its modes.
//
// Source   modes: Flanagan & Belytschko (1981); eight points with mean dilatation: Simo, Taylor & Pister (1985),
//          Hughes (1980)
// Symbols  X, x   undeformed, current position [m];  (xi, eta, zeta) in [-1,1]^3
//          x_m    modes of the element: sums of its nodes with signs, eight times the coefficients of xi ... xi eta zeta
//                 in the isoparametric map (components/space/shape.hpp)
//          F      deformation gradient dx/dX [-];  J = det F;  theta = current / undeformed volume of the element [-]
// One point: F = sum_m x_m g_m, the mean of dx/dX over the undeformed element; homogeneous deformations are exact,
// whatever the shape of the element. All functions take T = double, Packet or Lane.
#pragma once

#include "components/space/shape.hpp"
#include "engine/lane.hpp"

namespace pulvis::space::kernels {

template <class T>
struct Vector3 {
  T x, y, z;
};

template <class T>
struct Matrix3 {
  T xx, xy, xz, yx, yy, yz, zx, zy, zz;
};

// ---- modes -------------------------------------------------------------------------------------------
template <class T>
struct Modes {  // of one coordinate or force component
  T xi, eta, zeta, ez, zx, xe, xez;
};
template <class T>
struct ElementModes {
  Modes<T> x, y, z;
};

// `x(i)`: coordinate of corner i.
template <class T, class Coordinate>
Modes<T> modes_of(const Coordinate& x) {
  const T s0 = x(0) + x(1), d0 = x(1) - x(0), s1 = x(3) + x(2), d1 = x(2) - x(3);
  const T s2 = x(4) + x(5), d2 = x(5) - x(4), s3 = x(7) + x(6), d3 = x(6) - x(7);
  const T one0 = s0 + s1, eta0 = s1 - s0, xi0 = d0 + d1, xe0 = d1 - d0;
  const T one1 = s2 + s3, eta1 = s3 - s2, xi1 = d2 + d3, xe1 = d3 - d2;
  return {xi1 + xi0, eta1 + eta0, one1 - one0, eta1 - eta0, xi1 - xi0, xe1 + xe0, xe1 - xe0};
}

// Calls out(i, -sum_m mode_sign(m, i) t_m) for every corner.
template <class T, class Out>
void spread_force(const Modes<T>& t, const Out& out) {
  const T xi0 = t.zx - t.xi, xi1 = -t.zx - t.xi, eta0 = t.ez - t.eta, eta1 = -t.ez - t.eta;
  const T xe0 = t.xez - t.xe, xe1 = -t.xez - t.xe;
  const T low0 = t.zeta - eta0, high0 = t.zeta + eta0, low1 = -t.zeta - eta1, high1 = eta1 - t.zeta;
  const T xlow0 = xi0 - xe0, xhigh0 = xi0 + xe0, xlow1 = xi1 - xe1, xhigh1 = xi1 + xe1;
  out(0, low0 - xlow0);
  out(1, low0 + xlow0);
  out(2, high0 + xhigh0);
  out(3, high0 - xhigh0);
  out(4, low1 - xlow1);
  out(5, low1 + xlow1);
  out(6, high1 + xhigh1);
  out(7, high1 - xhigh1);
}

using Gradient = std::array<Point, Shape::modes>;

template <class T>
T component_gradient(const Modes<T>& m, const Gradient& g, std::size_t k) {
  const T hourglass = fma(m.ez, g[3][k], fma(m.zx, g[4][k], fma(m.xe, g[5][k], m.xez * g[6][k])));
  return fma(m.xi, g[0][k], fma(m.eta, g[1][k], fma(m.zeta, g[2][k], hourglass)));
}

// F = sum_m x_m g_m
template <class T>
Matrix3<T> deformation_gradient(const ElementModes<T>& m, const Gradient& g) {
  return {
      component_gradient(m.x, g, 0), component_gradient(m.x, g, 1), component_gradient(m.x, g, 2),
      component_gradient(m.y, g, 0), component_gradient(m.y, g, 1), component_gradient(m.y, g, 2),
      component_gradient(m.z, g, 0), component_gradient(m.z, g, 1), component_gradient(m.z, g, 2)};
}

// The transpose: adds p g_m to the modes of the forces, p a row of the first Piola-Kirchhoff stress times volume.
template <class T>
void add_gradient_force(Modes<T>& t, const Vector3<T>& p, const Gradient& g) {
  const auto add = [&](T sum, std::size_t m) {
    return fma(p.x, g[m][0], fma(p.y, g[m][1], fma(p.z, g[m][2], sum)));
  };
  t = {add(t.xi, 0), add(t.eta, 1), add(t.zeta, 2), add(t.ez, 3),
       add(t.zx, 4), add(t.xe, 5),  add(t.xez, 6)};
}

// ---- 3 x 3 ---------------------------------------------------------------------------------------------
template <class T>
T minor(T a, T b, T c, T d) {  // a d - b c
  return fma(a, d, -(b * c));
}

// det(m) m^-1
template <class T>
Matrix3<T> adjugate(const Matrix3<T>& m) {
  return {
      minor(m.yy, m.yz, m.zy, m.zz), minor(m.xz, m.xy, m.zz, m.zy), minor(m.xy, m.xz, m.yy, m.yz),
      minor(m.yz, m.yx, m.zz, m.zx), minor(m.xx, m.xz, m.zx, m.zz), minor(m.xz, m.xx, m.yz, m.yx),
      minor(m.yx, m.yy, m.zx, m.zy), minor(m.xy, m.xx, m.zy, m.zx), minor(m.xx, m.xy, m.yx, m.yy)};
}

// `adj`: its adjugate.
template <class T>
T determinant(const Matrix3<T>& m, const Matrix3<T>& adj) {
  return fma(m.xx, adj.xx, fma(m.xy, adj.yx, m.xz * adj.zx));
}

template <class T>
T dot(const Vector3<T>& a, T x, T y, T z) {
  return fma(a.x, x, fma(a.y, y, a.z * z));
}

template <class T>
Matrix3<T> scaled(const Matrix3<T>& m, T s) {
  return {m.xx * s, m.xy * s, m.xz * s, m.yx * s, m.yy * s, m.yz * s, m.zx * s, m.zy * s, m.zz * s};
}

template <class T>
Vector3<T> product(const Matrix3<T>& m, const Vector3<T>& v) {
  return {fma(m.xx, v.x, fma(m.xy, v.y, m.xz * v.z)), fma(m.yx, v.x, fma(m.yy, v.y, m.yz * v.z)),
          fma(m.zx, v.x, fma(m.zy, v.y, m.zz * v.z))};
}
template <class T>
Vector3<T> transposed_product(const Matrix3<T>& m, const Vector3<T>& v) {
  return {fma(m.xx, v.x, fma(m.yx, v.y, m.zx * v.z)), fma(m.xy, v.x, fma(m.yy, v.y, m.zy * v.z)),
          fma(m.xz, v.x, fma(m.yz, v.y, m.zz * v.z))};
}

// a b, where a is constant.
template <class T>
Matrix3<T> product(const Tensor& a, const Matrix3<T>& b) {
  const auto row = [&](std::size_t i, T x, T y, T z) {
    return fma(x, a[i], fma(y, a[i + 1], z * a[i + 2]));
  };
  return {row(0, b.xx, b.yx, b.zx), row(0, b.xy, b.yy, b.zy), row(0, b.xz, b.yz, b.zz),
          row(3, b.xx, b.yx, b.zx), row(3, b.xy, b.yy, b.zy), row(3, b.xz, b.yz, b.zz),
          row(6, b.xx, b.yx, b.zx), row(6, b.xy, b.yy, b.zy), row(6, b.xz, b.yz, b.zz)};
}
template <class T>
Matrix3<T> product(const Matrix3<T>& a, const Tensor& b) {
  const auto entry_of = [&](T x, T y, T z, std::size_t k) {
    return fma(x, b[k], fma(y, b[k + 3], z * b[k + 6]));
  };
  return {
      entry_of(a.xx, a.xy, a.xz, 0), entry_of(a.xx, a.xy, a.xz, 1), entry_of(a.xx, a.xy, a.xz, 2),
      entry_of(a.yx, a.yy, a.yz, 0), entry_of(a.yx, a.yy, a.yz, 1), entry_of(a.yx, a.yy, a.yz, 2),
      entry_of(a.zx, a.zy, a.zz, 0), entry_of(a.zx, a.zy, a.zz, 1), entry_of(a.zx, a.zy, a.zz, 2)};
}

// ---- eight points ----------------------------------------------------------------------------------------
inline constexpr double gauss = 0.57735026918962576451;  // 1/sqrt 3

struct GaussCoordinates {
  double xi, eta, zeta;
};
constexpr GaussCoordinates gauss_coordinates(int g) {
  return {g & 1 ? gauss : -gauss, g & 2 ? gauss : -gauss, g & 4 ? gauss : -gauss};
}

// d(8 x)/d(xi, eta, zeta) of one coordinate.
template <class T>
Vector3<T> map_row(const Modes<T>& m, const GaussCoordinates& at) {
  return {fma(m.xe, at.eta, fma(m.zx, at.zeta, fma(m.xez, at.eta * at.zeta, m.xi))),
          fma(m.xe, at.xi, fma(m.ez, at.zeta, fma(m.xez, at.xi * at.zeta, m.eta))),
          fma(m.zx, at.xi, fma(m.ez, at.eta, fma(m.xez, at.xi * at.eta, m.zeta)))};
}

// `inverse`: d(xi, eta, zeta)/dX at the point.
template <class T>
Matrix3<T> point_gradient(const ElementModes<T>& m, const Tensor& inverse,
                          const GaussCoordinates& at) {
  const Vector3<T> x = map_row(m.x, at), y = map_row(m.y, at), z = map_row(m.z, at);
  const Matrix3<T> f = product(Matrix3<T>{x.x, x.y, x.z, y.x, y.y, y.z, z.x, z.y, z.z}, inverse);
  return scaled(f, T{} + 0.125);
}

// The transpose: adds the force of a row p of the stress times volume.
template <class T>
void add_point_force(Modes<T>& t, const Vector3<T>& p, const Tensor& inverse,
                     const GaussCoordinates& at) {
  const auto along = [&](std::size_t i) {
    return 0.125 * fma(p.x, inverse[i], fma(p.y, inverse[i + 1], p.z * inverse[i + 2]));
  };
  const T xi = along(0), eta = along(3), zeta = along(6);
  t.xi += xi;
  t.eta += eta;
  t.zeta += zeta;
  t.ez = fma(zeta, at.eta, fma(eta, at.zeta, t.ez));
  t.zx = fma(xi, at.zeta, fma(zeta, at.xi, t.zx));
  t.xe = fma(xi, at.eta, fma(eta, at.xi, t.xe));
  t.xez = fma(xi, at.eta * at.zeta, fma(eta, at.xi * at.zeta, fma(zeta, at.xi * at.eta, t.xez)));
}

}  // namespace pulvis::space::kernels
