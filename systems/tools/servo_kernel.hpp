// A tool with a target force F_set that currently carries F: it moves as if it had a mass M, were pushed by
// F_set, and dragged a second mass m along through a dashpot c (Lanchester damper):
//   M dV/dt = F_set - F - c (V - W),   m dW/dt = c (V - W)
// Only the two masses store energy, so that no powder, however stiff, layered or damped, can be driven into
// oscillation by it. At rest, and at any steady speed, F = F_set; otherwise F_set - F = M dV/dt + m dW/dt.
// W stays between its last value and V: it does not wind up when V is limited.
//
// In time the tool is a leapfrog node like those of the powder (h the mean of two steps):
//   V+ = V + h/M (F_set - F_n - c (V+ - W+)),   W+ = W + h/m c (V+ - W+),   X+ = X + dt V+
// with its own dashpot implicit, which costs two divisions, and that of the contact explicit: F_n comes from
// positions at t_n and from velocities half a step before.
//
// Stability. For M' x'' + C x' + K x with C evaluated half a step late, the leapfrog has the energy
//   E = 1/2 v (M' - dt C/2 - dt^2 K/4) v + 1/2 x_mean K x_mean,   dE/dt = -v_mean C v_mean
// as long as 4 M' > 2 dt C + dt^2 K (multiply the scheme by v_mean; an implicit dashpot only adds to M').
// The stable step of the powder (systems/body/time_step.cpp) gives dt^2 K <= 4 s^2 m_n and 2 dt C <= 4 s m_n in all,
// s its safety factor, with the tool at rest. A contact between a node x and the tool X adds at most
//   K (x - X)^2 <= K x^2/s^2 + K X^2/(1 - s^2),   C (x - X)^2 <= C x^2/s + C X^2/(1 - s)
// so that powder and tool together are stable at the time step of the powder alone, if summed over all contacts
//   M >= dt^2/(4 (1 - s^2)) sum K + dt/(2 (1 - s)) sum C
// M may be updated by this during the run, as mass that is added is at rest and mass that is released keeps its
// speed: both dissipate energy.
// Source: Hairer, Lubich and Wanner 2006 (leapfrog energy); Den Hartog 1956, ch. 3 (the damper).
#pragma once

#include <algorithm>
#include <cmath>

namespace pulvis::kernels {

// ---- what touches the tool ------------------------------------------------------------------------------
struct TouchSums {
  double stiffness = 0;  // N/m, tangent
  double damping = 0;    // N s/m
};

// Tangent of the contact spring kappa g (1 + (g/g_s)^2) at `pressure`, over kappa; an upper bound.
inline double tangent_at(double pressure, double kappa, double g_s) {
  const double q = pressure / (kappa * g_s);  // x (1 + x^2) for x = g/g_s
  double x = std::min(q, std::sqrt(q));       // above the root, where the Newton steps stay
  for (int i = 0; i < 4; ++i) x -= (x * (1 + x * x) - q) / (1 + 3 * x * x);
  return 1 + 3 * x * x;
}

// See above; `safety` in (0, 1).
inline double min_tool_mass(const TouchSums& touching, double dt, double safety) {
  return dt * dt / (4 * (1 - safety * safety)) * touching.stiffness +
         dt / (2 * (1 - safety)) * touching.damping;
}

// ---- its motion -----------------------------------------------------------------------------------------
struct ServoState {
  double mass;     // kg, M
  double speed;    // m/s, V
  double dragged;  // m/s, W
};

// The dragged mass is that many times the tool's: enough to damp it, without more force error than needed.
inline constexpr double dragged_mass = 4;
// Share of the mass that may be released per step: contacts come and go, and each time would brake the tool.
inline constexpr double let_go = 1e-3;

// The state after the mass is raised to at least `minimum`.
inline ServoState with_mass(const ServoState& s, double minimum) {
  if (minimum <= s.mass) return {std::max(minimum, (1 - let_go) * s.mass), s.speed, s.dragged};
  const double kept = s.mass / minimum;
  return {minimum, kept * s.speed, kept * s.dragged};
}

// `missing`: F_set - F, N. No faster than `max_speed`.
inline ServoState servo_step(const ServoState& s, double missing, double damping, double max_speed,
                             double h) {
  const double m = dragged_mass * s.mass;
  const double through = damping * m / (m + damping * h);  // force on W over V+ - W
  const double speed =
      (s.mass * s.speed + h * (missing + through * s.dragged)) / (s.mass + through * h);
  const double next = std::clamp(speed, -max_speed, max_speed);
  return {s.mass, next, s.dragged + through * h / m * (next - s.dragged)};
}

// ---- an elastic drive -----------------------------------------------------------------------------------
// A tool X of mass M behind a spring k and a dashpot c whose far end D follows its programme:
//   M dV/dt = k (D - X) + c (U - V) - F,   U = dD/dt
// by the leapfrog, the dashpot implicit:
//   V+ = V + h/M (k (D - X)_n + c (U+ - V+) - F_n)
// Stable as above, with k included in what touches the tool.
struct ElasticDrive {
  double mass, stiffness, damping;  // kg, N/m, N s/m
};
inline double elastic_speed(const ElasticDrive& drive, double speed, double behind,
                            double end_speed, double borne, double h) {
  return (drive.mass * speed + h * (drive.stiffness * behind - borne + drive.damping * end_speed)) /
         (drive.mass + drive.damping * h);
}

}  // namespace pulvis::kernels
