// Rate dependence: the hardening flow stress times a factor that grows with the plastic strain rate.
//
// Law      a struct with factor(rate) >= 1, factor(0) = 1, and slope(rate) [s], its derivative; for numbers and
//          lanes, rate in 1/s
// Source   Cowper & Symonds (1957)
#pragma once

#include <limits>
#include <variant>

#include "systems/laws/elementary.hpp"

namespace pulvis::kernels {

struct NoRate {};

// 1 + (rate/C)^(1/p)
struct CowperSymonds {
  static constexpr const char* name = "cowper-symonds";
  double C = 0;  // 1/s
  double p = 0;  // -
  template <class T>
  T factor(T rate) const {
    return 1.0 + power(rate / C, 1 / p);
  }
  template <class T>
  T slope(T rate) const {  // infinite at rest where p > 1
    return (1 / (p * C)) * power(rate / C, 1 / p - 1);
  }
};

using RateLaw = std::variant<NoRate, CowperSymonds>;

// Hardening and rate combined, over a step: yield starts at the hardening stress, and flow follows the combined stress.
template <class Hardening, class Rate>
struct RatedHardening {
  const Hardening& hardening;
  const Rate& rate;
  double over_dt;  // 1/s, inverse time step

  template <class T>
  T flow_stress(T eps) const {
    return hardening.flow_stress(eps);
  }
  template <class T>
  T modulus(T eps) const {
    return hardening.modulus(eps);
  }
};

template <class Hardening, class Rate>
RatedHardening(const Hardening&, const Rate&, double) -> RatedHardening<Hardening, Rate>;

// Flow stress and its slope after `grown` plastic strain has been added to `eps` in this step.
template <class T>
struct Flow {
  T stress, modulus;
};
template <class T, class Hardening>
Flow<T> flow_after(const Hardening& law, T eps, T grown) {
  const T now = eps + grown;
  return {law.flow_stress(now), law.modulus(now)};
}
template <class T, class Hardening, class Rate>
Flow<T> flow_after(const RatedHardening<Hardening, Rate>& law, T eps, T grown) {
  const Flow<T> slow = flow_after(law.hardening, eps, grown);
  const T rate = grown * law.over_dt, factor = law.rate.factor(rate);
  return {slow.stress * factor,
          slow.modulus * factor + slow.stress * law.rate.slope(rate) * law.over_dt};
}

// Contribution of the rate alone to the work of a step, J/m^3: that of hardening is the integral of its curve.
template <class T, class Hardening>
T rate_work(const Hardening&, T, T) {
  return T{};
}
template <class T, class Hardening, class Rate>
T rate_work(const RatedHardening<Hardening, Rate>& law, T eps, T grown) {
  const T slow = law.hardening.flow_stress(eps + grown);
  return slow * (law.rate.factor(grown * law.over_dt) - 1.0) * grown;
}

// Upper bound on the plastic strain of a step if the stress exceeds the hardening flow stress by `excess` times that stress.
template <class T, class Law>
T max_growth(const Law&, T) {
  return T{} + std::numeric_limits<double>::infinity();
}
template <class T, class Hardening>
T max_growth(const RatedHardening<Hardening, CowperSymonds>& law, T excess) {
  return (law.rate.C / law.over_dt) * power(max(excess, T{}), law.rate.p);
}

// A Newton step in x, in which f falls with slope `steep`.
template <class T, class Law>
T newton_step(const Law&, T x, T f, T steep) {
  return x + f / steep;
}
// The flow stress varies with the p-th root of the rate, vertical at rest. In x^(1/p) it is a line: from above the root
// the steps descend to it without overshooting.
template <class T, class Hardening>
T newton_step(const RatedHardening<Hardening, CowperSymonds>& law, T x, T f, T steep) {
  const double p = law.rate.p;
  return x * power(max(1.0 + f / (p * (x * steep)), T{}), p);
}

// Plastic work of a step beyond the area under the hardening curve, J/m^3 of undeformed volume: that of the rate, and that
// due to the Cauchy stress acting on theta times that volume.
template <class T, class Law>
T work_beyond_hardening(const Law& law, T eps, T grown, T theta) {
  const T stress = min(law.flow_stress(fma(T{} + 0.5, grown, eps)), 1e300);  // elastic: infinite
  return fma(theta - 1.0, stress * grown, theta * rate_work(law, eps, grown));
}

}  // namespace pulvis::kernels
