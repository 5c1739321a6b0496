// Contact pressure between surfaces that penetrate each other (the gap g [m] is then > 0).
//
// Spring   p = kappa/2 g (1 + (g/g_s)^2), in each of two half passes. g_s, a twentieth of the edge, is more
//          than yielding metals reach; the spring stiffens there, so that elastic bodies at large strain
//          and corners do not sink into each other.
// Damping  c [Pa s/m] on the rate of the gap (T 5.1); never pulls.
#pragma once

#include <limits>

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

// ---- indentation -----------------------------------------------------------------------------------------
// A contact that is narrower than an edge cannot indent the element behind it: pressure would rise without bound. Where it
// exceeds the hardness H of the surface, a point indents by d, so that kappa (g - d) (1 + ((g - d)/g_s)^2) = H, which takes
// the plastic work H dd. H = 1.25 p + C sigma_f, with p and the flow stress sigma_f of the element behind the edge. C = 2.97 for
// a rigid flat punch in plane strain (Prandtl: (2 + pi)/sqrt 3), about 3 for a ball (Tabor 1951).
//
// As the element behind flows, surfaces come to fit each other: d falls by 1/e over some plastic strain of the element, and
// the work comes back.
//
// A spring that reaches H only where it is several times as stiff as at first is no longer a penalty: no limit then.
inline constexpr double hardest = 0.5;              // H / (kappa g_s)
inline constexpr double deepest_indentation = 0.1;  // of the edge: more than that is the mesh's
inline constexpr double fitting_strain = 0.05;      // -
inline constexpr double no_hardness = std::numeric_limits<double>::infinity();  // never indents

template <class T>
struct Indentation {
  T depth;  // m
  T work;   // J/m^2, spent in this step
};

// Of the softer of two surfaces.
template <class T>
struct Hardness {
  T pressure;  // Pa, H
  T left;      // -, share of an indentation after the step
};

// Where the spring exceeds H: `fitted` m, the indentation so far; x + x^3 of the spring is to be H/(kappa g_s).
template <class T>
[[gnu::noinline]] Indentation<T> grown_indentation(T g, T before, T fitted, T H, T kappa,
                                                   T inv_edge) {
  const T per_depth = (1 / stiffening_depth) * inv_edge;
  const T x = max(g - fitted, T{}) * per_depth;
  const T y = H * per_depth / kappa;
  // Newton's method from below.
  T limit = y / fma(y, y, T{} + 1.0);
  for (int k = 0; k < 2; ++k)
    limit = limit - (limit * fma(limit, limit, T{} + 1.0) - y) / fma(3.0 * limit, limit, T{} + 1.0);
  const T most = max(fitted, deepest_indentation / inv_edge);
  const T grown = min(fitted + (x - limit) / per_depth, most);
  const auto grows = (y < hardest) & (x > limit);
  const T after = select(grows, grown, fitted);
  const T pressure = select(grows, H, kappa * x / per_depth * fma(x, x, T{} + 1.0));
  return {after, pressure * (after - before)};
}

// The indentation at a gap g, `before` a step. `share` of the pressure that the pass bears.
template <class T>
[[gnu::always_inline]] inline Indentation<T> indentation(T g, T before, const Hardness<T>& hardness,
                                                         double share, T kappa, T inv_edge) {
  const T H = share * hardness.pressure, fitted = before * hardness.left;
  const T spring = max(g - fitted, T{});
  const T depth = spring * ((1 / stiffening_depth) * inv_edge);
  const T pressure = kappa * spring * fma(depth, depth, T{} + 1.0);
  if (any(pressure > H)) return grown_indentation(g, before, fitted, H, kappa, inv_edge);
  return {fitted, pressure * (fitted - before)};
}

}  // namespace pulvis::kernels
