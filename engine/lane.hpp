// Four doubles worked on at once: one particle of a chunk (or one Gauss point of an edge) a lane.
//
// Compiler vector types: the arithmetic operators, comparisons and ?: read as for scalars, and g++ and
// clang++ turn them into one AVX2 instruction each. The same few functions exist for plain doubles, so
// that a kernel written with them is tested as a scalar and run on lanes.
#pragma once

#include <immintrin.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <type_traits>

namespace pulvis {

inline constexpr int lane_count = 4;

using Lane [[gnu::vector_size(32)]] = double;
using LaneMask [[gnu::vector_size(32)]] = std::int64_t;

inline Lane broadcast(double value) { return Lane{value, value, value, value}; }
inline Lane broadcast(Lane value) { return value; }

inline Lane select(LaneMask mask, Lane yes, Lane no) { return mask ? yes : no; }
inline double select(bool mask, double yes, double no) { return mask ? yes : no; }

#ifdef __AVX__
inline bool any(LaneMask mask) { return _mm256_movemask_pd(__m256d(mask)) != 0; }
inline bool all(LaneMask mask) { return _mm256_movemask_pd(__m256d(mask)) == 15; }
#else
inline bool any(LaneMask mask) { return (mask[0] | mask[1] | mask[2] | mask[3]) != 0; }
inline bool all(LaneMask mask) { return (mask[0] & mask[1] & mask[2] & mask[3]) != 0; }
#endif
inline bool any(bool mask) { return mask; }
inline bool all(bool mask) { return mask; }

// As std::min and std::max do it, so that a NaN in `a` stays one.
inline Lane min(Lane a, Lane b) { return b < a ? b : a; }
inline Lane max(Lane a, Lane b) { return a < b ? b : a; }
inline double min(double a, double b) { return std::min(a, b); }
inline double max(double a, double b) { return std::max(a, b); }

inline Lane abs(Lane a) { return max(a, -a); }
inline double abs(double a) { return std::abs(a); }

#ifdef __AVX__
inline Lane sqrt(Lane a) { return Lane(_mm256_sqrt_pd(__m256d(a))); }
#else
inline Lane sqrt(Lane a) {
  return Lane{std::sqrt(a[0]), std::sqrt(a[1]), std::sqrt(a[2]), std::sqrt(a[3])};
}
#endif
inline double sqrt(double a) { return std::sqrt(a); }

// a b + c, rounded once. Contraction is off for the whole build, so this is the only way to get one: the
// compilers cannot differ.
inline double fma(double a, double b, double c) { return std::fma(a, b, c); }
#ifdef __FMA__
inline Lane fused(Lane a, Lane b, Lane c) {
  return Lane(_mm256_fmadd_pd(__m256d(a), __m256d(b), __m256d(c)));
}
#else
inline Lane fused(Lane a, Lane b, Lane c) {
  return Lane{std::fma(a[0], b[0], c[0]), std::fma(a[1], b[1], c[1]), std::fma(a[2], b[2], c[2]),
              std::fma(a[3], b[3], c[3])};
}
#endif
template <class A, class B, class C>
requires(!(std::is_arithmetic_v<A> && std::is_arithmetic_v<B> && std::is_arithmetic_v<C>)) Lane
    fma(A a, B b, C c) {
  return fused(broadcast(a), broadcast(b), broadcast(c));
}

// Fixed-order sum and extremes of the lanes: the same bits on every machine.
inline double sum(Lane a) { return (a[0] + a[1]) + (a[2] + a[3]); }
inline double least(Lane a) { return std::min(std::min(a[0], a[1]), std::min(a[2], a[3])); }
inline double greatest(Lane a) { return std::max(std::max(a[0], a[1]), std::max(a[2], a[3])); }

}  // namespace pulvis
