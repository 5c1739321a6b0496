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
// A contact that is narrower than an edge cannot indent the element behind it: pressure would rise without bound. A point
// therefore indents by d > 0, so that
//   kappa (g - d) <= H d/(d + d_0),
// which takes the plastic work p dd. H is the hardness of the surface, some three times the flow stress for a punch in plane
// strain ((2 + pi)/sqrt 3, Prandtl) and for a ball (Tabor 1951). Half of it is reached at d_0: contact spreads over what a
// point stands for little by little.
//
// As the element behind flows, surfaces come to fit each other: d falls by 1/e over some plastic strain of the element, and
// the work comes back.
//
// A spring that reaches H only where it is several times as stiff as at first is no longer a penalty: no limit then.
inline constexpr double hardest = 0.5;  // H / (kappa g_s)
inline constexpr double half_indentation = 0.0025;  // d_0 over the edge, of each that indents
inline constexpr double deepest_indentation = 0.1;  // likewise: more than that is the mesh's
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

// The indentation at a gap g > 0 where the limit is exceeded; `fitted` m, that so far. `edge` m, once for each surface.
template <class T>
T grown_indentation(T g, T fitted, T H, T kappa, T edge) {
  const T rigid = H / kappa;
  // kappa e = H d/(d + d_0) with e = g - d.
  const T half = 0.5 * (g + half_indentation * edge + rigid);
  const T e = half - sqrt(max(half * half - g * rigid, T{}));
  const T grown = min(g - e, max(fitted, deepest_indentation * edge));
  const auto limited = (g > 0.0) & (rigid < (hardest * stiffening_depth) * edge);
  return select(limited, max(grown, fitted), fitted);
}

// The indentation at a gap g, `before` a step. `share` of the pressure that the pass bears: one half if both surfaces indent, so
// that a particle answers to its mirror image as to a rigid plane.
template <class T>
[[gnu::always_inline]] inline Indentation<T> indentation(T g, T before, const Hardness<T>& hardness,
                                                         double share, T kappa, T inv_edge) {
  const T H = share * hardness.pressure, fitted = before * hardness.left;
  const T linear = kappa * max(g - fitted, T{}), part = fitted * (share * inv_edge);
  T after = fitted;
  if (any(linear * (part + half_indentation) > H * part))
    after = grown_indentation(g, fitted, H, kappa, T(1.0 / (share * inv_edge)));
  const T spring = max(g - after, T{}), depth = spring * ((1 / stiffening_depth) * inv_edge);
  const T stiffer = fma(depth, depth, T{} + 1.0), pressure = kappa * spring * stiffer;
  T work = pressure * (after - before);
  // What grows does so along the limit: by the mean of the pressures before and after.
  if (any(after > before)) {
    const T at_first = before * (share * inv_edge);
    const T limit = min(H, 1e300) * at_first / (at_first + half_indentation);
    work -= 0.5 * (pressure - min(pressure, stiffer * limit)) * max(after - before, T{});
  }
  return {after, work};
}

}  // namespace pulvis::kernels
