// Force that a constraint needs to put on a node so that the leapfrog step takes the node where it must go.
//
// Source   systems/body/integrate.cpp: v' = v + f/m kick, x' = x + v' dt, with kick = (dt_before + dt)/2
// Symbols  all in the held direction: target m, the prescribed x'; free N, every other force
// Sign     the result acts on the node
#pragma once

namespace pulvis::kernels {

// The velocity comes from where the node is, not from the tool's: round-off cannot add up to a drift.
inline double constraint_force(double target, double x, double v, double free, double mass,
                               double kick, double dt) {
  const double wanted = (target - x) / dt;
  return mass * (wanted - v) / kick - free;
}

}  // namespace pulvis::kernels
