// Constraint force on a node that makes the leapfrog step take the node to its prescribed position.
//
// Source   systems/body/integrate.cpp: v' = v + f/m kick, x' = x + v' dt, with kick = (dt_before + dt)/2
// Symbols  all in the constrained direction: target m, the prescribed x'; free N, all other forces
// Sign     the result acts on the node
#pragma once

namespace pulvis::kernels {

// The velocity follows from the node's position, not the tool's: round-off cannot accumulate to a drift.
inline double constraint_force(double target, double x, double v, double free, double mass,
                               double kick, double dt) {
  const double wanted = (target - x) / dt;
  return mass * (wanted - v) / kick - free;
}

}  // namespace pulvis::kernels
