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

#include "components/servo.hpp"

namespace pulvis::kernels {

// ---- what touches the tool ------------------------------------------------------------------------------
struct TouchSums {
  double stiffness = 0;  // N/m, tangent
  double damping = 0;    // N s/m

  void include(const TouchSums& more) {
    stiffness += more.stiffness;
    damping += more.damping;
  }
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

// Speeds allowed in the two directions, m/s.
struct SpeedLimits {
  double backward, forward;
};

// `missing`: F_set - F, N.
inline ServoState servo_step(const ServoState& s, double missing, double damping,
                             const SpeedLimits& limits, double h) {
  const double m = dragged_mass * s.mass;
  const double through = damping * m / (m + damping * h);  // force on W over V+ - W
  const double speed =
      (s.mass * s.speed + h * (missing + through * s.dragged)) / (s.mass + through * h);
  const double next = std::clamp(speed, -limits.backward, limits.forward);
  return {s.mass, next, s.dragged + through * h / m * (next - s.dragged)};
}

// ---- the approach to its force ----------------------------------------------------------------------------
// A powder keeps what it was pressed by: the force may not pass F_set on its way up. On a spring K and a mass m, a
// tool of the speed V = (F_set - F)/R reaches F_set without passing it if R >= 2 sqrt(K m), its critical damping; here
// R = 2 sqrt(K m). m: of the tool and all of the powder m_p, which may fly freely before it is pressed. K: the slope of
// force over travel of late, by least squares, so that waves and contacts that come and go do not count as stiffness. A powder
// stiffens as it is pressed: K sqrt(F_set/F) is expected at F_set, up to Z^2/m_p of a solid block, where Z is the force of a
// wave into it over the wave's speed. Before the powder resists, V <= 2 F_set/Z.

// What the powder can do, from its materials and its size.
struct ServoPowder {
  double mass, wave;                                      // kg, N s/m
  double stiffest() const { return wave * wave / mass; }  // N/m
};

// Error within which a force counts as reached, relative to it, if its tolerance is larger.
inline constexpr double reached = 0.01;
// Time over which the response is measured, in passages of a wave through the block.
inline constexpr double passages = 4;

// `moved`: m, in the direction of the force, over the last step of length `dt`.
inline ServoResponse with_step(const ServoResponse& r, double force, double moved, double dt,
                               const ServoPowder& powder) {
  const double share = std::min(1.0, dt * powder.wave / (passages * powder.mass));
  const double lagging = r.force + share * (force - r.force);
  const double travel = (1 - share) * (r.travel + moved);
  const auto mean = [&](double before, double now) { return before + share * (now - before); };
  return {lagging, travel, mean(r.product, (force - lagging) * travel),
          mean(r.square, travel * travel)};
}

// Where a servo is to arrive, N.
struct ServoAim {
  double target;  // at the end of its stage
  double scale;   // largest force of the stage
  double near;    // within which the force counts as reached
};

// Fastest approach, m/s; `left`: N, to the target. `tool_mass`: kg.
inline double approach_speed(const ServoResponse& r, double left, const ServoAim& aim,
                             double tool_mass, const ServoPowder& powder) {
  const double target = std::abs(aim.target), force = std::max(target - left, aim.near);
  const double ahead =
      std::min(powder.stiffest(), r.stiffness() * std::sqrt(std::max(1.0, target / force)));
  const double resistance = 2 * std::sqrt(ahead * (powder.mass + tool_mass));
  const double unresisted = 2 * aim.scale / powder.wave;
  return resistance > 0 ? std::min(unresisted, left / resistance) : unresisted;
}

// Once a force is reached, or where the target lies below it, only `max_speed` applies.
inline SpeedLimits speed_limits(const ServoResponse& r, double force, const ServoAim& aim,
                                double tool_mass, double max_speed, const ServoPowder& powder) {
  SpeedLimits limits{max_speed, max_speed};
  const double left = std::abs(aim.target) - (aim.target < 0 ? -force : force);
  if (aim.target == 0 || left <= aim.near) return limits;
  double& towards = aim.target < 0 ? limits.backward : limits.forward;
  towards = std::min(max_speed, approach_speed(r, left, aim, tool_mass, powder));
  return limits;
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
                            double end_speed, double load, double h) {
  return (drive.mass * speed + h * (drive.stiffness * behind - load + drive.damping * end_speed)) /
         (drive.mass + drive.damping * h);
}

}  // namespace pulvis::kernels
