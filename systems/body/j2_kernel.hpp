// Finite-strain J2 elasto-plasticity, isotropic hardening, plane strain.
//
// Source   Simo & Hughes (1998), boxes 9.1 and 9.2: multiplicative split, radial return on the
//          isochoric elastic left Cauchy-Green tensor. Two departures: the state is the inverse plastic
//          metric C_p^-1 (as in Simo 1992), so that the stress follows from F alone and cannot drift;
//          and the trace after the return comes from det b_e = 1 instead of being kept, which makes
//          the stored energy follow the stress. (The plastic work is sigma_y d eps; the exact
//          dissipation differs from it by the square of the elastic strain.)
// Symbols  C      C_p^-1 - 1 [-] (xx yy zz xy; zero when virgin);  b = J^(-2/3) F C_p^-1 F^T [-]
//          mu, K  shear and bulk modulus [Pa];  theta element dilatation [-]
//          s      deviatoric Cauchy stress [Pa] = mu dev b / theta;  p mean stress [Pa]
//          sigma_y flow stress [Pa], H hardening modulus [Pa], eps accumulated plastic strain [-]
// Energy   W = mu/2 (tr b - 3) + K/2 (1/2 (theta^2 - 1) - ln theta)  per undeformed volume
// Valid    theta > 0, det F > 0; any strain
#pragma once

#include "engine/portable_math.hpp"
#include "systems/body/element_kernel.hpp"

namespace pulvis::kernels {

template <class T>
struct Symmetric3 {  // of a plane problem: out-of-plane shear is zero
  T xx, yy, zz, xy;
};

template <class T>
T trace(const Symmetric3<T>& a) {
  return a.xx + a.yy + a.zz;
}

template <class T>
T squared_norm(const Symmetric3<T>& a) {
  return fma(a.xx, a.xx, a.yy * a.yy) + fma(a.zz, a.zz, 2.0 * (a.xy * a.xy));
}

// b before the isochoric scaling: F C_p^-1 F^T; elastic material has C = 0.
template <class T>
Symmetric3<T> left_cauchy_green(const Matrix2<T>& f) {
  return {fma(f.xx, f.xx, f.xy * f.xy), fma(f.yx, f.yx, f.yy * f.yy), T{} + 1.0,
          fma(f.xx, f.yx, f.xy * f.yy)};
}
template <class T>
Symmetric3<T> left_cauchy_green(const Matrix2<T>& f, const Symmetric3<T>& c) {
  const T cxx = 1.0 + c.xx, cyy = 1.0 + c.yy;
  const T gxx = fma(f.xx, cxx, f.xy * c.xy), gxy = fma(f.xx, c.xy, f.xy * cyy);
  const T gyx = fma(f.yx, cxx, f.yy * c.xy), gyy = fma(f.yx, c.xy, f.yy * cyy);
  return {fma(gxx, f.xx, gxy * f.xy), fma(gyx, f.yx, gyy * f.yy), 1.0 + c.zz,
          fma(gxx, f.yx, gxy * f.yy)};
}

// scale * dev(b), as xx yy xy (zz follows).
template <class T>
struct Deviator {
  T xx, yy, xy;
};
template <class T>
Deviator<T> scaled_deviator(const Symmetric3<T>& b, T scale) {
  const T mean = trace(b) * (1.0 / 3.0);
  return {scale * (b.xx - mean), scale * (b.yy - mean), scale * b.xy};
}
template <class T>
T squared_norm(const Deviator<T>& s) {
  const T zz = s.xx + s.yy;
  return fma(s.xx, s.xx, s.yy * s.yy) + fma(zz, zz, 2.0 * (s.xy * s.xy));
}

// dU/dtheta of U = K/2 (1/2 (theta^2 - 1) - ln theta): grows without bound as theta -> 0.
template <class T>
T mean_stress(T bulk_modulus, T theta) {
  return 0.5 * bulk_modulus * (theta - 1.0 / theta);
}

// Isotropic hardening. A law is a struct with flow_stress(eps) and plastic_work(eps) that is linear in
// eps over a step with slope modulus(eps); perfectly plastic is H = 0.
template <class T>
struct LinearHardening {
  T sigma_y, H;
  T flow_stress(T eps) const { return fma(H, eps, sigma_y); }
  T modulus(T) const { return H; }
  T plastic_work(T eps) const { return eps * (sigma_y + 0.5 * H * eps); }  // J/m^3
};

// What stands beside the deviator under the yield surface: nothing. (Bending: hourglass_kernel.hpp.)
struct NothingBeside {
  template <class T>
  T joint_norm(T norm2) const {
    return norm2;
  }
  template <class T>
  T slope(T, T, T norm, T modulus, T two_mu) const {
    return norm * fma(2.0 / 3.0, modulus, two_mu);
  }
  template <class T>
  T push(T excess, T) const {
    return excess;
  }
  template <class T, class Hardening>
  void settle(const auto&, T&, T&, T, T, T, const Hardening&) const {}
};

template <class T, class Hardening>
auto yields(const Deviator<T>& s, T eps, const Hardening& law, const auto& beside) {
  const T limit = law.flow_stress(eps);
  return beside.joint_norm(squared_norm(s)) > (2.0 / 3.0) * limit * limit;
}
template <class T, class Hardening>
auto yields(const Deviator<T>& s, T eps, const Hardening& law) {
  return yields(s, eps, law, NothingBeside{});
}

template <class T>
struct J2State {
  Deviator<T> s;    // Cauchy, Pa
  Symmetric3<T> c;  // C_p^-1 - 1
  T eps;
};

// Mean m of b = d + m 1 with det b = 1, from q = d:d / 2 and det d: m^3 - q m + det d = 1. The elastic
// strain is small; the series leaves out its eighth order.
template <class T>
T mean_of_unit_determinant(T q, T det) {
  const T a = (1.0 / 3.0) * q, e = (1.0 / 3.0) * det, t = a - e;
  const T third_order = (1.0 / 3.0) * (a * a) * fma(-a, a, a);  // of q
  return 1.0 + (fma(e, t, t) - third_order);
}

// Radial return of the trial state at a Gauss point. Lanes that do not yield come back unchanged.
// `r2` = J^(-2/3). b_trial is not formed again: its deviator is theta s / mu, its mean follows from
// det b = 1. `beside` is returned with the deviator.
template <class T, class Hardening, class Beside>
J2State<T> radial_return(const J2State<T>& trial, const Matrix2<T>& f, T r2, T mu_over_theta,
                         T theta_over_mu, const Hardening& law, Beside&& beside) {
  constexpr double sqrt_2_3 = 0.81649658092772603273;
  const auto flows = yields(trial.s, trial.eps, law, beside);
  const T norm2 = squared_norm(trial.s), joint2 = beside.joint_norm(norm2), norm = sqrt(joint2);
  const T dxx = theta_over_mu * trial.s.xx, dyy = theta_over_mu * trial.s.yy;
  const T dxy = theta_over_mu * trial.s.xy;
  const T q = (0.5 * norm2) * (theta_over_mu * theta_over_mu);  // 1/2 d : d
  const T det = (dxx + dyy) * fma(dxy, dxy, -(dxx * dyy));      // det d

  const T mean = mean_of_unit_determinant(q, det);
  const T two_mu_bar = 2.0 * mu_over_theta * mean;

  // Consistency: |s| - 2 mu_bar dgamma = sqrt(2/3) sigma_y(eps + sqrt(2/3) dgamma), mu_bar = mu tr b/3;
  // beta = |s_new| / |s_trial|.
  const T excess = beside.push(fma(-sqrt_2_3, law.flow_stress(trial.eps), norm), norm);
  const T slope = beside.slope(norm2, joint2, norm, law.modulus(trial.eps), two_mu_bar);
  const T over = select(flows, excess / slope, T{});
  T dgamma = norm * over;
  T beta = fma(-two_mu_bar, over, 1.0);
  beside.settle(flows, beta, dgamma, norm2, two_mu_bar, trial.eps, law);

  const T beta2 = beta * beta;
  const T m = mean_of_unit_determinant(beta2 * q, beta2 * beta * det);

  // Pulled back: C_p^-1 = beta C_p^-1 + (m - beta mean) J^(2/3) (F^T F)^-1.
  const T shift = fma(-beta, mean, m);
  const T j = determinant(f);
  const T pull = shift * (r2 * r2);  // J^(2/3) / J^2
  const T cxx = fma(f.xy, f.xy, f.yy * f.yy), cyy = fma(f.xx, f.xx, f.yx * f.yx);
  const T cxy = -fma(f.xx, f.xy, f.yx * f.yy);
  const T grow = beta - 1.0;
  J2State<T> next;
  next.s = {beta * trial.s.xx, beta * trial.s.yy, beta * trial.s.xy};
  next.c = {fma(beta, trial.c.xx, fma(pull, cxx, grow)),
            fma(beta, trial.c.yy, fma(pull, cyy, grow)),
            fma(beta, trial.c.zz, fma(pull * j, j, grow)), fma(beta, trial.c.xy, pull * cxy)};
  next.eps = fma(sqrt_2_3, dgamma, trial.eps);
  return next;
}

template <class T, class Hardening>
J2State<T> radial_return(const J2State<T>& trial, const Matrix2<T>& f, T r2, T mu_over_theta,
                         T theta_over_mu, const Hardening& law) {
  return radial_return(trial, f, r2, mu_over_theta, theta_over_mu, law, NothingBeside{});
}

// Stored energy per undeformed volume, without the volumetric part (which the element has once).
template <class T>
T isochoric_energy(const Matrix2<T>& f, const Symmetric3<T>& c, T mu) {
  const T r = inverse_cube_root(determinant(f));
  return 0.5 * mu * (r * r * trace(left_cauchy_green(f, c)) - 3.0);
}
inline double volumetric_energy(double bulk_modulus, double theta) {
  return 0.5 * bulk_modulus * (0.5 * (theta * theta - 1) - portable::log(theta));
}

}  // namespace pulvis::kernels
