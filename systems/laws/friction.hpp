// What shear stress surfaces bear that press on each other.
//
// Friction Coulomb with a tangential spring u [m] per point, return-mapped (Cundall & Strack 1979, as
//          plasticity: Wriggers 2006, ch. 5). The slip increment is objective: the rotation of the
//          surface across the gap is taken out, and the same term acts on the other body, so that
//          angular momentum is kept although the two points are a gap apart.
#pragma once

#include "engine/lane.hpp"
#include "systems/laws/elementary.hpp"

namespace pulvis::kernels {

template <class T>
struct Friction {
  T traction;      // Pa, on the sampled body along t
  T elastic_slip;  // m, new
  T work;          // J/m^2, of this step: what the spring does not keep of the mean traction's
};

// ---- friction laws ------------------------------------------------------------------------------------
// A law says what shear stress the surfaces bear at a pressure, and what sliding does to that: a struct with
// strength(pressure) [Pa] and slide(distance) [m, >= 0].
template <class T>
struct Coulomb {
  T mu;
  T strength(T pressure) const { return mu * pressure; }
  void slide(T) {}
};

// What speed does to the coefficient: mu(v) = mu + a ln(1 + v/v_0), the direct effect of rate-dependent friction
// (Dieterich 1979, Ruina 1983), which is mu at rest. v is the whole relative speed of the last step: that of the
// tangential spring is small against it once the surfaces slide.
template <class T>
T rate_effect(T speed, T rate, T inv_speed) {
  return rate *
         each_number(fma(speed, inv_speed, T{} + 1.0), [](double x) { return portable::log(x); });
}

// Static and dynamic friction: the static part fades as e^(-distance/decay) (backward Euler), and comes back when
// the surfaces part. No more than the shear strength of the softer surface.
template <class T>
struct Weakening {
  T mu;         // dynamic
  T drop;       // static less dynamic
  T inv_decay;  // 1/m
  T maximum;    // Pa; of one pass
  T lost;       // share of the static part that has faded
  T by_speed;   // what the speed adds to the coefficient
  T strength(T pressure) const {
    return min(max(fma(drop, 1.0 - lost, mu) + by_speed, T{}) * pressure, maximum);
  }
  void slide(T distance) { lost = 1.0 - (1.0 - lost) / fma(distance, inv_decay, T{} + 1.0); }
};

// `slip` m: how far the sampled body slid along t in the last step; `inv_kappa` = 1 / kappa. The traction is
// returned to what the law allows.
template <class T, class Law>
Friction<T> friction_return(T elastic_slip, T slip, T pressure, Law& law, T kappa, T inv_kappa) {
  const T trial = elastic_slip + slip;
  const T limit = law.strength(pressure) * inv_kappa;
  const T held = max(min(trial, limit), -limit);
  // Mean traction of the step times what slipped: with the spring's energy it is all of the mean traction's work on the
  // slip. It is negative where the pressure falls while the slip reverses over the whole limit in one step.
  const T work = 0.5 * kappa * (elastic_slip + held) * (trial - held);
  law.slide(abs(trial - held));
  return {-(kappa * held), held, work};
}

// The same in a plane, with vectors V whose dot product is found by their names.
template <class V, class T>
struct PlaneFriction {
  V traction;      // Pa, on the sampled body
  V elastic_slip;  // m, new
  T work;          // J/m^2, of this step
};
// The trial spring is shortened to what the law allows; its direction stays (radial return).
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
