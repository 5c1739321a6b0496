// One register of doubles for the instruction set at hand: the building block of engine/lane.hpp.
//
// +, -, *, / and unary - on these types are built into the compilers. Comparisons, selection, roots and
// fused operations are defined here.
#pragma once

#ifdef __AVX2__
#include <immintrin.h>
#endif

#include <bit>
#include <cmath>
#include <cstdint>

namespace pulvis::simd {

#if defined(__AVX512F__) && defined(__AVX512DQ__)

inline constexpr const char* instruction_set = "AVX-512";
using Register = __m512d;
using Mask = __mmask8;  // one bit per lane

inline Register broadcast(double a) { return _mm512_set1_pd(a); }
inline Register load(const double* p) { return _mm512_loadu_pd(p); }
inline void store(double* p, Register a) { _mm512_storeu_pd(p, a); }
inline Register fma(Register a, Register b, Register c) { return _mm512_fmadd_pd(a, b, c); }
inline Register sqrt(Register a) { return _mm512_sqrt_pd(a); }
inline Register whole(Register a) {
  return _mm512_roundscale_pd(a, _MM_FROUND_TO_ZERO | _MM_FROUND_NO_EXC);
}
inline Register lesser(Register a, Register b) { return _mm512_min_pd(a, b); }
inline Register greater(Register a, Register b) { return _mm512_max_pd(a, b); }
inline Mask less(Register a, Register b) { return _mm512_cmp_pd_mask(a, b, _CMP_LT_OQ); }
inline Mask less_or_equal(Register a, Register b) { return _mm512_cmp_pd_mask(a, b, _CMP_LE_OQ); }
inline Mask equal(Register a, Register b) { return _mm512_cmp_pd_mask(a, b, _CMP_EQ_OQ); }
inline Register select(Mask m, Register yes, Register no) {
  return _mm512_mask_blend_pd(m, no, yes);
}
inline Mask opposite(Mask a) { return Mask(~a); }
inline unsigned bits(Mask a) { return a; }
inline Mask mask_of(unsigned set) { return Mask(set); }

#elif defined(__AVX2__) && defined(__FMA__)

inline constexpr const char* instruction_set = "AVX2";
using Register = __m256d;
using Mask = __m256i;  // all bits of a lane set or clear

inline Register broadcast(double a) { return _mm256_set1_pd(a); }
inline Register load(const double* p) { return _mm256_loadu_pd(p); }
inline void store(double* p, Register a) { _mm256_storeu_pd(p, a); }
inline Register fma(Register a, Register b, Register c) { return _mm256_fmadd_pd(a, b, c); }
inline Register sqrt(Register a) { return _mm256_sqrt_pd(a); }
inline Register whole(Register a) {
  return _mm256_round_pd(a, _MM_FROUND_TO_ZERO | _MM_FROUND_NO_EXC);
}
inline Register lesser(Register a, Register b) { return _mm256_min_pd(a, b); }
inline Register greater(Register a, Register b) { return _mm256_max_pd(a, b); }
inline Mask less(Register a, Register b) {
  return _mm256_castpd_si256(_mm256_cmp_pd(a, b, _CMP_LT_OQ));
}
inline Mask less_or_equal(Register a, Register b) {
  return _mm256_castpd_si256(_mm256_cmp_pd(a, b, _CMP_LE_OQ));
}
inline Mask equal(Register a, Register b) {
  return _mm256_castpd_si256(_mm256_cmp_pd(a, b, _CMP_EQ_OQ));
}
inline Register select(Mask m, Register yes, Register no) {
  return _mm256_blendv_pd(no, yes, _mm256_castsi256_pd(m));
}
inline Mask opposite(Mask a) { return ~a; }
inline unsigned bits(Mask a) {
  return static_cast<unsigned>(_mm256_movemask_pd(_mm256_castsi256_pd(a)));
}
inline Mask mask_of(unsigned set) {
  const auto lane = [set](int i) { return -static_cast<long long>(set >> i & 1); };
  return _mm256_setr_epi64x(lane(0), lane(1), lane(2), lane(3));
}

#else

inline constexpr const char* instruction_set = "portable";
using Register [[gnu::vector_size(16), gnu::may_alias]] = double;
using Mask [[gnu::vector_size(16)]] = long long;

inline Register broadcast(double a) { return Register{a, a}; }
inline Register load(const double* p) { return Register{p[0], p[1]}; }
inline void store(double* p, Register a) { p[0] = a[0], p[1] = a[1]; }
inline Register fma(Register a, Register b, Register c) {
  return Register{std::fma(a[0], b[0], c[0]), std::fma(a[1], b[1], c[1])};
}
inline Register sqrt(Register a) { return Register{std::sqrt(a[0]), std::sqrt(a[1])}; }
inline Register whole(Register a) { return Register{std::trunc(a[0]), std::trunc(a[1])}; }
inline Register lesser(Register a, Register b) { return a < b ? a : b; }
inline Register greater(Register a, Register b) { return a > b ? a : b; }
inline Mask less(Register a, Register b) { return a < b; }
inline Mask less_or_equal(Register a, Register b) { return a <= b; }
inline Mask equal(Register a, Register b) { return a == b; }
inline Register select(Mask m, Register yes, Register no) { return m ? yes : no; }
inline Mask opposite(Mask a) { return ~a; }
inline unsigned bits(Mask a) {
  return static_cast<unsigned>(a[0] & 1) | static_cast<unsigned>(a[1] & 2);
}
inline Mask mask_of(unsigned set) {
  return Mask{-static_cast<long long>(set & 1), -static_cast<long long>(set >> 1 & 1)};
}

#endif

inline constexpr int register_lanes = sizeof(Register) / sizeof(double);

}  // namespace pulvis::simd
