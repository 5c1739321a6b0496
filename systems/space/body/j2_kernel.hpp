// Finite-strain J2 elasto-plasticity in three dimensions: systems/body/j2_kernel.hpp with all components.
//
// Source   Simo & Hughes (1998), boxes 9.1 and 9.2, with the inverse plastic metric C_p^-1 as the state and the trace from det b =
//          1: see there. The multiplier is found by the same functions
// Symbols  C      C_p^-1 - 1 [-] (xx yy zz xy yz zx; zero when virgin);  b = J^(-2/3) F C_p^-1 F^T [-]
//          mu, K  shear and bulk modulus [Pa];  theta element dilatation [-]
//          s      deviatoric Cauchy stress [Pa] = mu dev b / theta;  p mean stress [Pa]
// Energy   W = mu/2 (tr b - 3) + K/2 (1/2 (theta^2 - 1) - ln theta)  per undeformed volume
// Valid    theta > 0, det F > 0; any strain
#pragma once

#include "systems/body/j2_kernel.hpp"
#include "systems/space/body/element_kernel.hpp"

namespace pulvis::space::kernels {

using pulvis::kernels::consistent;
using pulvis::kernels::inverse_cube_root;
using pulvis::kernels::mean_of_unit_determinant;
using pulvis::kernels::Multiplier;
using pulvis::kernels::sqrt_2_3;
using pulvis::kernels::Trial;
using pulvis::kernels::Uncoupled;

template <class T>
struct Symmetric3 {
  T xx, yy, zz, xy, yz, zx;
};

template <class T>
T trace(const Symmetric3<T>& a) {
  return a.xx + a.yy + a.zz;
}

// m s m^T
template <class T>
Symmetric3<T> congruent(const Matrix3<T>& m, const Symmetric3<T>& s) {
  const auto row = [&](T x, T y, T z) {
    return Vector3<T>{fma(x, s.xx, fma(y, s.xy, z * s.zx)), fma(x, s.xy, fma(y, s.yy, z * s.yz)),
                      fma(x, s.zx, fma(y, s.yz, z * s.zz))};
  };
  const Vector3<T> x = row(m.xx, m.xy, m.xz), y = row(m.yx, m.yy, m.yz), z = row(m.zx, m.zy, m.zz);
  return {dot(x, m.xx, m.xy, m.xz), dot(y, m.yx, m.yy, m.yz), dot(z, m.zx, m.zy, m.zz),
          dot(x, m.yx, m.yy, m.yz), dot(y, m.zx, m.zy, m.zz), dot(z, m.xx, m.xy, m.xz)};
}
// m m^T
template <class T>
Symmetric3<T> square(const Matrix3<T>& m) {
  const Vector3<T> x{m.xx, m.xy, m.xz}, y{m.yx, m.yy, m.yz}, z{m.zx, m.zy, m.zz};
  return {dot(x, x.x, x.y, x.z), dot(y, y.x, y.y, y.z), dot(z, z.x, z.y, z.z),
          dot(x, y.x, y.y, y.z), dot(y, z.x, z.y, z.z), dot(z, x.x, x.y, x.z)};
}

// b before the isochoric scaling: F C_p^-1 F^T; elastic material has C = 0.
template <class T>
Symmetric3<T> left_cauchy_green(const Matrix3<T>& f, const Symmetric3<T>& c) {
  return congruent(f, Symmetric3<T>{1.0 + c.xx, 1.0 + c.yy, 1.0 + c.zz, c.xy, c.yz, c.zx});
}

// scale * dev(b), as xx yy xy yz zx (zz follows).
template <class T>
struct Deviator {
  T xx, yy, xy, yz, zx;
  T zz() const { return -(xx + yy); }
};
template <class T>
Deviator<T> scaled_deviator(const Symmetric3<T>& b, T scale) {
  const T mean = trace(b) * (1.0 / 3.0);
  return {scale * (b.xx - mean), scale * (b.yy - mean), scale * b.xy, scale * b.yz, scale * b.zx};
}
template <class T>
Deviator<T> scaled(const Deviator<T>& s, T by) {
  return {by * s.xx, by * s.yy, by * s.xy, by * s.yz, by * s.zx};
}
template <class T>
T squared_norm(const Deviator<T>& s) {
  const T zz = s.xx + s.yy, shear = fma(s.xy, s.xy, fma(s.yz, s.yz, s.zx * s.zx));
  return fma(s.xx, s.xx, fma(s.yy, s.yy, fma(zz, zz, 2.0 * shear)));
}
template <class T>
T determinant(const Deviator<T>& s) {
  const T zz = s.zz();
  return fma(s.xx, fma(s.yy, zz, -(s.yz * s.yz)),
             fma(s.xy, fma(s.yz, s.zx, -(s.xy * zz)), s.zx * fma(s.xy, s.yz, -(s.yy * s.zx))));
}

// dU/dtheta; `over` = 1/theta.
template <class T>
T mean_stress(T bulk, T theta, T over) {
  return 0.5 * bulk * (theta - over);
}

// ---- the return map ------------------------------------------------------------------------------------
// Data of a point that may yield: trial deviator, accumulated plastic strain, and the kinematics of the step.
template <class T>
struct TrialPoint {
  Deviator<T> s;
  T eps;
  T mu_over_theta, theta_over_mu;
};

template <class T>
struct Return {
  T beta;   // share of the deviator that remains
  T eps;    // after the return
  T shift;  // m - beta m_trial of b
  T mean;   // m of the trial b
  T work;   // -, pulvis::kernels::work_of_large_strain
  T residual;
};

// Steps 2 to 4 of the box; lanes that do not yield return beta = 1, shift = 0. `coupled`: what shares the yield
// surface with the deviator, of squared norm norm2.
template <class T, class Hardening, class Coupled>
Return<T> radial_return(const TrialPoint<T>& at, T norm2, const Hardening& law, Coupled&& coupled) {
  const T joint2 = coupled.joint_norm(norm2);
  const T q = (0.5 * norm2) * (at.theta_over_mu * at.theta_over_mu);  // 1/2 d : d, d = dev b
  const T det = determinant(scaled(at.s, at.theta_over_mu));
  const T mean = mean_of_unit_determinant(q, det);

  const T limit = law.flow_stress(at.eps);
  const auto flows = joint2 > (2.0 / 3.0) * limit * limit;
  const Trial<T> trial{norm2, joint2, sqrt(joint2), at.eps, 2.0 * at.mu_over_theta * mean};
  const Multiplier<T> flow = consistent(flows, trial, law, coupled);
  const T beta = flow.beta, beta2 = beta * beta;
  const T after = mean_of_unit_determinant(beta2 * q, beta2 * beta * det);
  return {beta,
          fma(sqrt_2_3, flow.dgamma, at.eps),
          fma(-beta, mean, after),
          mean,
          pulvis::kernels::work_of_large_strain(after, beta, q, det),
          flow.residual};
}

// Step 6: C_p^-1 = beta C_p^-1 + shift J^(2/3) (F^T F)^-1, with the adjugate of F and r2 = J^(-2/3).
template <class T>
Symmetric3<T> returned_cp_inverse(const Symmetric3<T>& c, const Return<T>& r, const Matrix3<T>& adj,
                                  T r2) {
  const Symmetric3<T> inverse = square(adj);
  const T pull = r.shift * (r2 * r2), grow = r.beta - 1.0;
  return {fma(r.beta, c.xx, fma(pull, inverse.xx, grow)),
          fma(r.beta, c.yy, fma(pull, inverse.yy, grow)),
          fma(r.beta, c.zz, fma(pull, inverse.zz, grow)),
          fma(r.beta, c.xy, pull * inverse.xy),
          fma(r.beta, c.yz, pull * inverse.yz),
          fma(r.beta, c.zx, pull * inverse.zx)};
}

// Stored energy per undeformed volume, without the volumetric part (evaluated once per element). `r2` = J^(-2/3).
template <class T>
T isochoric_energy(const Matrix3<T>& f, const Symmetric3<T>& c, T mu, T r2) {
  return 0.5 * mu * (r2 * trace(left_cauchy_green(f, c)) - 3.0);
}

}  // namespace pulvis::space::kernels
