// Shear traction between surfaces in contact.
//
// Friction Coulomb with a tangential spring u [m] per point, return-mapped (Cundall & Strack 1979, as
//          plasticity: Wriggers 2006, ch. 5). The slip increment is objective: the rotation of the
//          surface across the gap is removed, and the same term acts on the other body, so that
//          angular momentum is conserved although the two points are a gap apart.
#pragma once

#include "components/surface_laws.hpp"
#include "engine/lane.hpp"
#include "systems/laws/elementary.hpp"

namespace pulvis::kernels {

template <class T>
struct Friction {
  T traction;      // Pa, on the sampled body along t
  T elastic_slip;  // m, new value
  T work;          // J/m^2, in this step: work of the mean traction that the spring does not store
};

// ---- friction laws ------------------------------------------------------------------------------------
// A law gives the shear strength of the surfaces at a pressure, and the effect of sliding on it: a struct with
// strength(pressure) [Pa] and slide(distance) [m, >= 0].
template <class T>
struct Coulomb {
  T mu;
  T strength(T pressure) const { return mu * pressure; }
  void slide(T) {}
};

// Effect of velocity on the coefficient: mu(v) = mu + a ln(1 + v/v_0), the direct effect of rate-dependent friction
// (Dieterich 1979, Ruina 1983), equal to mu at rest. v is the total relative velocity of the last step: that of the
// tangential spring is small in comparison once the surfaces slide.
template <class T>
T rate_effect(T speed, T rate, T inv_speed) {
  return rate *
         each_number(fma(speed, inv_speed, T{} + 1.0), [](double x) { return portable::log(x); });
}

// Static and dynamic friction: the static part decays as e^(-distance/decay) (backward Euler), and is restored when
// the surfaces separate. Limited by the shear strength of the softer surface.
template <class T>
struct Weakening {
  T mu;         // dynamic
  T drop;       // static minus dynamic
  T inv_decay;  // 1/m
  T maximum;    // Pa; in one pass
  T lost;       // share of the static part that has decayed
  T by_speed;   // what velocity adds to the coefficient
  T strength(T pressure) const {
    return min(max(fma(drop, 1.0 - lost, mu) + by_speed, T{}) * pressure, maximum);
  }
  void slide(T distance) { lost = 1.0 - (1.0 - lost) / fma(distance, inv_decay, T{} + 1.0); }
};

// From the parameters of the surfaces: `read(number)` gives number(parameters), for all of T at once. `share` of a stress that
// this pass bears: one half if the other particle samples back. `speed` m/s, of sliding.
template <class T, class Read>
[[gnu::always_inline]] inline Weakening<T> weakening(const Read& read, double share, const T& lost,
                                                     const T& speed) {
  using Of = const FrictionParameters&;
  const T rate = read([](Of f) { return f.rate; });
  return {
      .mu = read([](Of f) { return f.coefficient; }),
      .drop = read([](Of f) { return f.static_excess(); }),
      .inv_decay = read([](Of f) { return 1 / f.decay_length; }),
      .maximum = share * read([](Of f) { return f.shear_strength; }),
      .lost = lost,
      .by_speed = any(abs(rate) > 0.0)
                      ? rate_effect(speed, rate, read([](Of f) { return 1 / f.reference_speed; }))
                      : T{}};
}

// `slip` m: how far the sampled body slid along t in the last step; `inv_kappa` = 1 / kappa. The traction is
// returned to the limit of the law.
template <class T, class Law>
Friction<T> friction_return(T elastic_slip, T slip, T pressure, Law& law, T kappa, T inv_kappa) {
  const T trial = elastic_slip + slip;
  const T limit = law.strength(pressure) * inv_kappa;
  const T held = max(min(trial, limit), -limit);
  // Mean traction of the step times the slip: together with the spring energy it is the total work of the mean traction
  // on the slip. It is negative if the pressure drops while the slip reverses over the whole limit in one step.
  const T work = 0.5 * kappa * (elastic_slip + held) * (trial - held);
  law.slide(abs(trial - held));
  return {-(kappa * held), held, work};
}

// The same in a plane, with vectors V whose dot product is found by argument-dependent lookup.
template <class V, class T>
struct PlaneFriction {
  V traction;      // Pa, on the sampled body
  V elastic_slip;  // m, new value
  T work;          // J/m^2, in this step
};
// The trial spring is shortened to the limit of the law; its direction is kept (radial return).
template <class V, class T, class Law>
PlaneFriction<V, T> friction_return_in_plane(const V& elastic_slip, const V& slip, T pressure,
                                             Law& law, T kappa, T inv_kappa) {
  const V trial = elastic_slip + slip;
  const T size = sqrt(dot(trial, trial));
  const T limit = law.strength(pressure) * inv_kappa;
  const T share = select(size > limit, limit / size, T{} + 1.0);
  const V held = share * trial;
  const T work = 0.5 * kappa * (1.0 - share) * dot(elastic_slip + held, trial);
  law.slide((1.0 - share) * size);
  return {-(kappa * held), held, work};
}

}  // namespace pulvis::kernels
