// Traction with which surfaces in or near contact attract each other, without memory.
//
// Law      sigma (1 - 3 x^2 + 2 x^3), x = s/h from 0 to 1, s the gap and h its range; sigma = 2 w/h in contact,
//          so that separating them takes the work of adhesion w [J/m^2]. Like Maugis's (1992) constant traction, but
//          it fades smoothly: no force jumps when a point comes into range.
// Sign     g > 0 in penetration, s = -g
#pragma once

#include "components/surface_laws.hpp"
#include "engine/lane.hpp"

namespace pulvis::kernels {

template <class T>
struct Attraction {
  T traction;  // Pa, >= 0, on the sampled body against n
  T energy;    // J/m^2, <= 0; 0 apart
};

// `sigma` Pa; `range` m, 0: none.
template <class T>
Attraction<T> adhesion(T g, T sigma, T range) {
  const T zero{};
  const T gap = max(-g, zero), depth = max(g, zero);
  const T x = min(gap / max(range, zero + 1e-300), zero + 1.0);
  const T x2 = x * x;
  const T left = 0.5 - x + x2 * x - 0.5 * x2 * x2;  // integral from x to 1
  return {sigma * (1.0 - x2 * (3.0 - 2.0 * x)), -(sigma * fma(range, left, depth))};
}

// Of surfaces with these parameters: all that attracts them. `read(number)` gives number(parameters), for all of T at once.
template <class T, class Read>
Attraction<T> attraction(T g, const Read& read) {
  using Of = const AdhesionParameters&;
  return adhesion<T>(g, read([](Of a) { return a.traction; }), read([](Of a) { return a.range; }));
}

}  // namespace pulvis::kernels
