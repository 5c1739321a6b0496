// Bulk damping of a hexahedron: stresses proportional to the strain rate. Laws, source and validity as in two
// dimensions (systems/body/damping_kernel.hpp).
//
// Symbols  L = F' F^-1, D = sym L   rate of deformation [1/s], at the positions half a step back, where it is
//                                   zero for any rigid rotation, however large
//          p'                       rates of the hourglass components (hourglass_kernel.hpp): fibre F^-1 (h' - L h)
// Law      s = beta 2 mu/theta dev D,   p = beta K/2 (theta + 1/theta) tr D,   hourglass stress = beta moduli e(p')
#pragma once

#include "systems/space/body/hourglass_kernel.hpp"
#include "systems/space/body/j2_kernel.hpp"

namespace pulvis::space::kernels {

template <class T>
struct Viscosity {
  T shear, bulk;              // Pa s: beta times 2 mu, K
  HourglassModuli<T> moduli;  // Pa s: beta times the moduli
};

// The modes of `now`, moved back half a step.
template <class T>
ElementModes<T> halfway_back(const ElementModes<T>& now, const ElementModes<T>& rate,
                             double half_step) {
  const auto back = [&](const Modes<T>& x, const Modes<T>& v) {
    const auto of = [&](T a, T b) { return fma(b, -half_step, a); };
    return Modes<T>{of(x.xi, v.xi), of(x.eta, v.eta), of(x.zeta, v.zeta), of(x.ez, v.ez),
                    of(x.zx, v.zx), of(x.xe, v.xe),   of(x.xez, v.xez)};
  };
  return {back(now.x, rate.x), back(now.y, rate.y), back(now.z, rate.z)};
}

// L = F' F^-1.
template <class T>
Matrix3<T> velocity_gradient(const Matrix3<T>& rate, const Matrix3<T>& adj, T inv_j) {
  const auto row = [&](T x, T y, T z) {
    return Vector3<T>{fma(x, adj.xx, fma(y, adj.yx, z * adj.zx)),
                      fma(x, adj.xy, fma(y, adj.yy, z * adj.zy)),
                      fma(x, adj.xz, fma(y, adj.yz, z * adj.zz))};
  };
  const auto x = row(rate.xx, rate.xy, rate.xz), y = row(rate.yx, rate.yy, rate.yz),
             z = row(rate.zx, rate.zy, rate.zz);
  return scaled(Matrix3<T>{x.x, x.y, x.z, y.x, y.y, y.z, z.x, z.y, z.z}, inv_j);
}

template <class T>
Symmetric3<T> symmetric_part(const Matrix3<T>& l) {
  return {l.xx, l.yy, l.zz, 0.5 * (l.xy + l.yx), 0.5 * (l.yz + l.zy), 0.5 * (l.zx + l.xz)};
}

template <class T>
T viscous_mean_stress(T bulk, T theta, T inv_theta, T dilatation) {
  return 0.5 * bulk * (theta + inv_theta) * dilatation;
}

// `to`: for the positions half a step back, with modes `m`.
template <class T>
HourglassComponents<T> hourglass_rates(const ElementModes<T>& m, const ElementModes<T>& rate,
                                       const Matrix3<T>& l, const Matrix3<T>& to) {
  const auto of = [&](const Vector3<T>& h, const Vector3<T>& v) {
    const Vector3<T> turned = product(l, h);
    return product(to, Vector3<T>{v.x - turned.x, v.y - turned.y, v.z - turned.z});
  };
  return {of({m.x.ez, m.y.ez, m.z.ez}, {rate.x.ez, rate.y.ez, rate.z.ez}),
          of({m.x.zx, m.y.zx, m.z.zx}, {rate.x.zx, rate.y.zx, rate.z.zx}),
          of({m.x.xe, m.y.xe, m.z.xe}, {rate.x.xe, rate.y.xe, rate.z.xe}),
          of({m.x.xez, m.y.xez, m.z.xez}, {rate.x.xez, rate.y.xez, rate.z.xez})};
}

}  // namespace pulvis::space::kernels
