// Plastic flow of the hourglass modes of the one-point hexahedron: their stress shares one yield surface with the
// deviator, and both are returned together.
//
// Source   a yield surface as in Ilyushin (1948) for plates: |s|^2 + t^2 <= 2/3 sigma_y^2, with t^2 such that each
//          mode alone carries the load of its fully plastic section: 3/2 of the stress at the edge of a plate in
//          linear bending, 9/4 of that at the corners if it varies with xi eta. With a deviator it carries
//          sqrt(1 - n^2) of it, n = |s|/(sqrt(2/3) sigma_y): between 1 - n^2 where s stretches the same fibres, and
//          sqrt((1 - n^2)(1 + n^2/3)) where it does not
// Symbols  those of systems/space/body/hourglass_kernel.hpp;  M stresses of the modes [Pa]
//          t^2 = 8/27 (sum^2 + 3 difference^2 + 3 shear^2) of the plates + 32/243 M_4^2
#pragma once

#include "systems/space/body/hourglass_kernel.hpp"
#include "systems/space/body/j2_kernel.hpp"

namespace pulvis::space::kernels {

template <class T>
T hourglass_norm2(const Hourglass<T>& m) {
  const auto plate = [](const PlateMode<T>& s) {
    return fma(s.sum, s.sum, 3.0 * fma(s.difference, s.difference, s.shear * s.shear));
  };
  const T plates = plate(m.plate1) + plate(m.plate2) + plate(m.plate3);
  const T last = fma(m.last.x, m.last.x, fma(m.last.y, m.last.y, m.last.z * m.last.z));
  return (8.0 / 27.0) * fma(last, 4.0 / 9.0, plates);
}

// Both flow along their stresses, t `softness` times as fast as s: ratio of the compliance of t to that of s. For
// pulvis::kernels::consistent.
template <class T>
struct CoupledHourglass {
  T squared;    // t^2, trial
  T softness;   // t^2 / (2 mu * twice the energy of t)
  T stiffness;  // 1/softness
  T retained;   // share of t that remains after the return

  T joint_norm(T norm2) const { return norm2 + squared; }
  // Slope of the consistency condition and the residual, both times |S|^2.
  T slope(T norm2, T joint2, T, T modulus, T two_mu) const {
    return fma((2.0 / 3.0) * joint2, modulus, two_mu * fma(softness, squared, norm2));
  }
  T push(T excess, T norm) const { return excess * norm; }

  // For nonlinear laws the return is iterated on the joint surface itself.
  T farthest(T two_mu) const { return max(stiffness, T{} + 1.0) / two_mu; }
  pulvis::kernels::Remaining<T> keep(T beta, const Trial<T>& t) {
    const T kept = max(beta, T{});
    retained = max(fma(softness, beta - 1.0, 1.0), T{});
    const T size = sqrt(fma(kept * kept, t.norm2, retained * retained * squared));
    return {size, -(t.two_mu_bar / size) * fma(kept, t.norm2, softness * (retained * squared))};
  }

  // If the linear step ends outside the surface by over a ten-thousandth (of the squares), the stresses are scaled
  // back radially. The dissipated work is then computed with the final stresses.
  template <class Mask, class Hardening>
  void settle(const Mask& flows, T& beta, T& dgamma, T norm2, T two_mu, T eps,
              const Hardening& law) {
    retained = max(fma(softness, beta - 1.0, 1.0), T{});
    const T outside = fma(beta * beta, norm2, retained * retained * squared);
    const T limit = sqrt_2_3 * law.flow_stress(fma(sqrt_2_3, dgamma, eps));
    const auto beyond = flows & (outside > (1 + 1e-4) * (limit * limit));
    if (!any(beyond)) return;
    const T root = sqrt(outside), cost = two_mu * limit;
    const T over = 1.0 / (root * cost);  // one division for two
    const T in = select(beyond, limit * cost * over, T{} + 1.0);
    beta *= in;
    retained *= in;
    const T spent =
        fma(beta * (1.0 - beta), norm2, retained * (1.0 - retained) * (squared * stiffness));
    dgamma = select(beyond, spent * (root * over), dgamma);
  }
};

// `squared` = t^2, `energy2` = twice the energy of t, `limit2` = 2/3 sigma_y^2. If t is almost zero, the
// softness of shear is used.
template <class T>
CoupledHourglass<T> coupled_hourglass(T squared, T energy2, T mu, T limit2) {
  const auto some = squared > 1e-24 * limit2;
  const T t2 = select(some, squared, T{} + 4.0),
          stored = select(some, 2.0 * mu * energy2, T{} + 3.0);
  const T over = 1.0 / (t2 * stored);
  return {squared, t2 * t2 * over, stored * stored * over, T{} + 1.0};
}

}  // namespace pulvis::space::kernels
