// Finite-strain J2 elasto-plasticity, isotropic hardening (systems/laws), plane strain.
//
// Source   Simo & Hughes (1998), boxes 9.1 and 9.2: multiplicative split, radial return on the
//          isochoric elastic left Cauchy-Green tensor. Two departures: the state is the inverse plastic
//          tensor C_p^-1 (as in Simo 1992), so that the stress follows from F alone and cannot drift;
//          and the trace after the return follows from det b_e = 1 instead of being kept, so that the
//          stored energy is consistent with the stress. The plastic work is theta sigma_y d eps per undeformed
//          volume (systems/laws/rate.hpp), times work_of_large_strain.
// Symbols  C      C_p^-1 - 1 [-] (xx yy zz xy; zero when virgin);  b = J^(-2/3) F C_p^-1 F^T [-]
//          mu, K  shear and bulk modulus [Pa];  theta element dilatation [-]
//          s      deviatoric Cauchy stress [Pa] = mu dev b / theta;  p mean stress [Pa]
//          sigma_y flow stress [Pa], H hardening modulus [Pa], eps accumulated plastic strain [-]
// Energy   W = mu/2 (tr b - 3) + K/2 (1/2 (theta^2 - 1) - ln theta)  per undeformed volume
// Valid    theta > 0, det F > 0; arbitrary strain
#pragma once

#include "engine/portable_math.hpp"
#include "systems/body/element_kernel.hpp"
#include "systems/laws/hardening.hpp"
#include "systems/laws/rate.hpp"

namespace pulvis::kernels {

template <class T>
struct Symmetric3 {  // plane problem: out-of-plane shear is zero
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

// b before the isochoric scaling: F C_p^-1 F^T; virgin material has C = 0.
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

// |S_trial| and its parts, the state at the start of the step, and 2 mu_bar.
template <class T>
struct Trial {
  T norm2, joint2, norm;
  T eps, two_mu_bar;
};

// The stress that a given multiplier leaves under the yield surface.
template <class T>
struct Remaining {
  T size, slope;  // |S|; its derivative with respect to x
};

// What shares the yield surface with the deviator. Nothing in elements that need no stabilisation; for one-point
// elements see systems/body/j2_bending_kernel.hpp. |S| is the joint norm, x = dgamma / |S_trial|.
struct Uncoupled {
  template <class T>
  T joint_norm(T norm2) const {
    return norm2;
  }
  // For the linear step: slope of the consistency condition, excess stress, and what remains to be done.
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
  // For the iteration: the x at which |S| is zero; |S| and its slope in x at beta = 1 - 2 mu x.
  template <class T>
  T farthest(T two_mu) const {
    return 1.0 / two_mu;
  }
  template <class T>
  Remaining<T> keep(T beta, const Trial<T>& t) const {
    return {t.norm * beta, -(t.two_mu_bar * t.norm)};
  }
};

template <class T, class Hardening>
auto yields(const Deviator<T>& s, T eps, const Hardening& law, const auto& coupled) {
  const T limit = law.flow_stress(eps);
  return coupled.joint_norm(squared_norm(s)) > (2.0 / 3.0) * limit * limit;
}
template <class T, class Hardening>
auto yields(const Deviator<T>& s, T eps, const Hardening& law) {
  return yields(s, eps, law, Uncoupled{});
}

template <class T>
struct J2State {
  Deviator<T> s;    // Cauchy, Pa
  Symmetric3<T> c;  // C_p^-1 - 1
  T eps;
};

// Mean m of b = d + m 1 with det b = 1, from q = d:d / 2 and det d: m^3 - q m + det d = 1. The elastic
// strain is small; the series drops terms of eighth order.
template <class T>
T mean_of_unit_determinant(T q, T det) {
  const T a = (1.0 / 3.0) * q, e = (1.0 / 3.0) * det, t = a - e;
  const T third_order = (1.0 / 3.0) * (a * a) * fma(-a, a, a);  // in q
  return 1.0 + (fma(e, t, t) - third_order);
}

// ---- step 4: the plastic multiplier -------------------------------------------------------------------
inline constexpr double sqrt_2_3 = 0.81649658092772603273;

template <class T>
struct Multiplier {
  T dgamma;
  T beta;        // |s| / |s_trial|
  T residual{};  // of the consistency condition relative to the flow stress, where it is not met
};

template <class Law>
inline constexpr bool is_closed_form = false;
template <class T>
inline constexpr bool is_closed_form<LinearHardening<T>> = true;

// Linear hardening: the condition is linear in dgamma.
template <class T, class Coupled, class Mask>
Multiplier<T> consistent(const Mask& flows, const Trial<T>& t, const LinearHardening<T>& law,
                         Coupled& coupled) {
  const T excess = coupled.push(fma(-sqrt_2_3, law.flow_stress(t.eps), t.norm), t.norm);
  const T slope = coupled.slope(t.norm2, t.joint2, t.norm, law.modulus(t.eps), t.two_mu_bar);
  const T x = select(flows, excess / slope, T{});
  Multiplier<T> m{t.norm * x, fma(-t.two_mu_bar, x, 1.0)};
  coupled.settle(flows, m.beta, m.dgamma, t.norm2, t.two_mu_bar, t.eps, law);
  return m;
}

// The condition counts as met within this share of the flow stress plus round-off of the trial stress; or where the
// bracket is no wider than round-off of the plastic strain, on almost vertical curves.
inline constexpr double consistency = 1e-12, consistency_of_trial = 1e-15, round_off = 4e-16;
inline constexpr int max_iterations = 200;

// A NaN residual never counts as met.
template <class T>
T unmet(T f, const Flow<T>& flow, T trial, T width, T eps) {
  const T allowed = select(width <= round_off * eps, flow.stress,
                           consistency * flow.stress + consistency_of_trial * trial);
  return select(abs(f) <= allowed, T{}, T{} + 1.0);
}

// Any other law: Newton's method in x, bisecting the bracket when a step leaves it. |S| falls with x, the flow stress
// does not, so there is one root. It starts from perfect plasticity, or from the rate that alone carries the excess.
template <class T, class Hardening, class Coupled, class Mask>
Multiplier<T> consistent(const Mask& flows, const Trial<T>& t, const Hardening& law,
                         Coupled& coupled) {
  const auto remaining = [&](T x) { return coupled.keep(fma(-t.two_mu_bar, x, 1.0), t); };
  const T excess = fma(-sqrt_2_3, law.flow_stress(t.eps), t.norm);
  T low{}, high = coupled.farthest(t.two_mu_bar), residual{};
  const T perfect = min(excess / -remaining(low).slope, high);
  const T by_rate = max_growth(law, excess / (sqrt_2_3 * law.flow_stress(t.eps)));
  T x = select(flows, min(perfect, by_rate / (sqrt_2_3 * t.norm)), T{});
  Mask open = flows;
  for (int i = 0; i < max_iterations; ++i) {
    const Remaining<T> left = remaining(x);
    const T to_strain = sqrt_2_3 * t.norm, grown = to_strain * x;
    const Flow<T> flow = flow_after(law, t.eps, grown);
    const T f = fma(-sqrt_2_3, flow.stress, left.size);
    open = open & (unmet(f, flow, t.norm, to_strain * (high - low), t.eps + grown) > 0.0);
    if (!any(open)) break;
    residual = f / flow.stress;
    low = select(f > 0.0, x, low);
    high = select(f > 0.0, high, x);
    const T newton = newton_step(law, x, f, fma((2.0 / 3.0) * t.norm, flow.modulus, -left.slope));
    const auto inside = (newton > low) & (newton < high);
    x = select(open, select(inside, newton, 0.5 * (low + high)), x);
  }
  remaining(x);
  return {t.norm * x, max(fma(-t.two_mu_bar, x, 1.0), T{}), select(open, residual, T{})};
}

// Plastic work over theta sigma_y d eps: what a return takes of the stored energy, mu/2 (tr b - 3), over what the linear
// relation of stress and strain would. Of the first order in the elastic deviator d, with q = d:d / 2.
template <class T>
T work_of_large_strain(T mean, T beta, T q, T det) {
  return mean * fma(T{} - 1.5, beta * det / max(q, 1e-300), 1.0);
}

// ---- the return map ------------------------------------------------------------------------------------
// Returns the trial state of a Gauss point to the yield surface; lanes that do not yield are left unchanged.
// Numbered as box 9.1, whose steps 1, 2 and 5 trial_stress has already done: the configuration and its F, the
// elastic predictor s_trial, the mean stress. `r2` = J^(-2/3). `coupled` is returned with the deviator.
template <class T>
struct Returned : J2State<T> {
  T mean;      // of the trial b
  T work;      // -, work_of_large_strain
  T residual;  // Multiplier::residual
};

template <class T, class Hardening, class Coupled>
Returned<T> radial_return(const J2State<T>& trial, const Matrix2<T>& f, T r2, T mu_over_theta,
                          T theta_over_mu, const Hardening& law, Coupled&& coupled) {
  // 2. b_trial is not rebuilt: its deviator d is theta s / mu, its mean follows from det b = 1.
  const T norm2 = squared_norm(trial.s), joint2 = coupled.joint_norm(norm2);
  const T dxx = theta_over_mu * trial.s.xx, dyy = theta_over_mu * trial.s.yy;
  const T dxy = theta_over_mu * trial.s.xy;
  const T q = (0.5 * norm2) * (theta_over_mu * theta_over_mu);  // 1/2 d : d
  const T det = (dxx + dyy) * fma(dxy, dxy, -(dxx * dyy));      // det d
  const T mean = mean_of_unit_determinant(q, det);

  // 3. Plastic loading?  f_trial = |s_trial| - sqrt(2/3) sigma_y(eps_n) > 0
  const auto flows = yields(trial.s, trial.eps, law, coupled);

  // 4. Return: |s_trial| - 2 mu_bar dgamma = sqrt(2/3) sigma_y(eps_n + sqrt(2/3) dgamma), mu_bar = mu tr b/3;
  //    s = beta s_trial, eps = eps_n + sqrt(2/3) dgamma
  const Trial<T> t{norm2, joint2, sqrt(joint2), trial.eps, 2.0 * mu_over_theta * mean};
  const Multiplier<T> flow = consistent(flows, t, law, coupled);
  const T beta = flow.beta;
  Returned<T> next;
  next.s = {beta * trial.s.xx, beta * trial.s.yy, beta * trial.s.xy};
  next.eps = fma(sqrt_2_3, flow.dgamma, trial.eps);
  next.residual = flow.residual;

  // 6. Intermediate configuration: b = beta dev b_trial + m 1 with det b = 1, pulled back:
  //    C_p^-1 = beta C_p^-1 + (m - beta mean) J^(2/3) (F^T F)^-1
  const T beta2 = beta * beta;
  const T m = mean_of_unit_determinant(beta2 * q, beta2 * beta * det);
  const T shift = fma(-beta, mean, m);
  next.mean = mean;
  next.work = work_of_large_strain(m, beta, q, det);
  const T j = determinant(f);
  const T pull = shift * (r2 * r2);  // J^(2/3) / J^2
  const T cxx = fma(f.xy, f.xy, f.yy * f.yy), cyy = fma(f.xx, f.xx, f.yx * f.yx);
  const T cxy = -fma(f.xx, f.xy, f.yx * f.yy);
  const T grow = beta - 1.0;
  next.c = {fma(beta, trial.c.xx, fma(pull, cxx, grow)),
            fma(beta, trial.c.yy, fma(pull, cyy, grow)),
            fma(beta, trial.c.zz, fma(pull * j, j, grow)), fma(beta, trial.c.xy, pull * cxy)};
  return next;
}

template <class T, class Hardening>
Returned<T> radial_return(const J2State<T>& trial, const Matrix2<T>& f, T r2, T mu_over_theta,
                          T theta_over_mu, const Hardening& law) {
  return radial_return(trial, f, r2, mu_over_theta, theta_over_mu, law, Uncoupled{});
}

// Stored energy per undeformed volume, without the volumetric part (stored once per element).
template <class T>
T isochoric_energy(const Matrix2<T>& f, const Symmetric3<T>& c, T mu) {
  const T r = inverse_cube_root(determinant(f));
  return 0.5 * mu * (r * r * trace(left_cauchy_green(f, c)) - 3.0);
}
inline double volumetric_energy(double bulk_modulus, double theta) {
  return 0.5 * bulk_modulus * (0.5 * (theta * theta - 1) - portable::log(theta));
}

}  // namespace pulvis::kernels
