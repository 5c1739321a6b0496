// Contact pressure between surfaces that penetrate each other (the gap g [m] is then > 0).
//
// Spring   p = kappa/2 g (1 + (g/g_s)^2), in each of two half passes. g_s, a twentieth of the edge, is more
//          than yielding metals reach; the spring stiffens there, so that elastic bodies at large strain
//          and corners do not sink into each other.
// Damping  c [Pa s/m] on the rate of the gap (T 5.1); never pulls.
#pragma once

#include "engine/lane.hpp"

namespace pulvis::kernels {

template <class T>
struct Traction {
  T pressure;       // Pa, >= 0, on the sampled body along n
  T spring_energy;  // J/m^2
  T damping_power;  // W/m^2, >= 0
};

// Penetration over edge length at which the spring carries twice the force of a linear one.
inline constexpr double stiffening_depth = 0.05;

// Tangent of the spring over kappa at a penetration of `depth` edge lengths.
inline double stiffening(double depth) {
  const double x = depth / stiffening_depth;
  return 1 + 3 * x * x;
}

// g > 0 in penetration, g_rate its growth [m/s]; kappa and c of one pass; `inv_edge` 1/m, inverse length of
// the edge.
template <class T>
Traction<T> normal_traction(T g, T g_rate, T kappa, T c, T inv_edge) {
  const T zero{};
  const T touching = max(g, zero);
  const T depth = touching * ((1 / stiffening_depth) * inv_edge);
  const T more = depth * depth;
  const T spring = kappa * touching * (1.0 + more);
  const T total = select(g > 0.0, max(spring + c * g_rate, zero), zero);
  return {total, 0.5 * kappa * touching * touching * (1.0 + 0.5 * more), (total - spring) * g_rate};
}

}  // namespace pulvis::kernels
