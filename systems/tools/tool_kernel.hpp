// Smooth prescribed motion: the share of a displacement covered at the share tau of its duration.
//
// The speed rises from zero over the first `ramp` of the duration as u^3 (10 - 15 u + 6 u^2) (so that
// acceleration and jerk start at zero: no stress wave is sent), stays constant, and falls likewise.
#pragma once

#include <algorithm>

namespace pulvis::kernels {

// Integral of u^3 (10 - 15 u + 6 u^2) from 0 to u in [0, 1]; 1/2 at u = 1.
inline double ramp_integral(double u) { return u * u * u * u * (2.5 + u * (-3.0 + u)); }

// The rise of the speed from 0 at u = 0 to 1 at u = 1.
inline double ramp_speed(double u) { return u * u * u * (10 + u * (-15 + 6 * u)); }

inline double smooth_travel(double tau, double ramp) {
  if (tau <= 0) return 0;
  if (tau >= 1) return 1;
  const double top_speed = 1 / (1 - ramp);
  if (tau > 0.5) return 1 - smooth_travel(1 - tau, ramp);
  const double rising = ramp > 0 ? ramp * ramp_integral(std::min(tau / ramp, 1.0)) : 0;
  return top_speed * (rising + std::max(tau - ramp, 0.0));
}

// Speed of smooth_travel: its derivative.
inline double smooth_speed(double tau, double ramp) {
  if (tau <= 0 || tau >= 1) return 0;
  const double u = std::min(tau, 1 - tau) / ramp;
  return (u < 1 ? ramp_speed(u) : 1) / (1 - ramp);
}

// The same, but from `cut` on the speed falls to zero within another `ramp`, mirroring its rise.
inline double cut_travel(double tau, double ramp, double cut) {
  if (tau <= cut) return smooth_travel(tau, ramp);
  const double u = std::min((tau - cut) / ramp, 1.0);
  return smooth_travel(cut, ramp) + smooth_speed(cut, ramp) * ramp * (u - ramp_integral(u));
}

// Share of the displacement still to come if the speed begins to fall at `tau`; at the end it does anyway.
inline double travel_to_rest(double tau, double ramp) {
  return tau < 1 - ramp ? 0.5 * ramp * smooth_speed(tau, ramp) : 1 - smooth_travel(tau, ramp);
}

}  // namespace pulvis::kernels
