// Lanes whose values come from several places in memory: halves of four, and eight rows of eight.
#pragma once

#include "engine/lane.hpp"

namespace pulvis {

// The first four lanes from `low`, the others from `high`.
inline Lane load_halves(const double* low, const double* high) {
#ifdef __AVX512F__
  Lane a;
  a.part[0] =
      _mm512_insertf64x4(_mm512_castpd256_pd512(_mm256_loadu_pd(low)), _mm256_loadu_pd(high), 1);
  return a;
#else
  constexpr std::size_t half = simd::registers / 2;
  Lane a;
  for (std::size_t i = 0; i < half; ++i) {
    a.part[i] = simd::load(low + i * simd::register_lanes);
    a.part[half + i] = simd::load(high + i * simd::register_lanes);
  }
  return a;
#endif
}
inline Lane halves(double low, double high) {
  const std::array<double, 4> a{low, low, low, low}, b{high, high, high, high};
  return load_halves(a.data(), b.data());
}

// Half 0 or 1 of a lane.
inline void store_half(const Lane& a, int half, double* four) {
#ifdef __AVX512F__
  _mm256_storeu_pd(
      four, half == 0 ? _mm512_castpd512_pd256(a.part[0]) : _mm512_extractf64x4_pd(a.part[0], 1));
#else
  constexpr std::size_t count = simd::registers / 2;
  for (std::size_t i = 0; i < count; ++i)
    simd::store(four + i * simd::register_lanes,
                a.part[static_cast<std::size_t>(half) * count + i]);
#endif
}

// Of a half, in a fixed order: the same bits on every machine.
inline double sum_of_half(const Lane& a, int half) {
  std::array<double, 4> v;
  store_half(a, half, v.data());
  return (v[0] + v[1]) + (v[2] + v[3]);
}
inline double least_of_half(const Lane& a, int half) {
  std::array<double, 4> v;
  store_half(a, half, v.data());
  return std::min(std::min(v[0], v[1]), std::min(v[2], v[3]));
}
inline double greatest_of_half(const Lane& a, int half) { return -least_of_half(-a, half); }

namespace simd {
#if defined(__AVX512F__)
inline std::array<Lane, 8> columns_of(const std::array<const double*, 8>& row) {
  __m512d r[8], t[8];
  for (std::size_t i = 0; i < 8; ++i) r[i] = _mm512_loadu_pd(row[i]);
  for (std::size_t i = 0; i < 8; i += 2) {
    t[i] = _mm512_unpacklo_pd(r[i], r[i + 1]);
    t[i + 1] = _mm512_unpackhi_pd(r[i], r[i + 1]);
  }
  // 128-bit pieces of four rows, then of all.
  const auto low = [](__m512d a, __m512d b) { return _mm512_shuffle_f64x2(a, b, 0x88); };
  const auto high = [](__m512d a, __m512d b) { return _mm512_shuffle_f64x2(a, b, 0xdd); };
  std::array<Lane, 8> column;
  for (std::size_t k = 0; k < 2; ++k) {
    const __m512d a = low(t[k], t[k + 2]), b = high(t[k], t[k + 2]);
    const __m512d c = low(t[k + 4], t[k + 6]), d = high(t[k + 4], t[k + 6]);
    column[k].part[0] = low(a, c);
    column[k + 4].part[0] = high(a, c);
    column[k + 2].part[0] = low(b, d);
    column[k + 6].part[0] = high(b, d);
  }
  return column;
}
#elif defined(__AVX2__) && defined(__FMA__)
inline std::array<Lane, 8> columns_of(const std::array<const double*, 8>& row) {
  std::array<Lane, 8> column;
  for (std::size_t i = 0; i < 2; ++i)      // rows 4 i ... + 3
    for (std::size_t k = 0; k < 2; ++k) {  // columns 4 k ... + 3
      __m256d r[4];
      for (std::size_t l = 0; l < 4; ++l) r[l] = _mm256_loadu_pd(row[4 * i + l] + 4 * k);
      const __m256d a = _mm256_unpacklo_pd(r[0], r[1]), b = _mm256_unpackhi_pd(r[0], r[1]);
      const __m256d c = _mm256_unpacklo_pd(r[2], r[3]), d = _mm256_unpackhi_pd(r[2], r[3]);
      column[4 * k].part[i] = _mm256_permute2f128_pd(a, c, 0x20);
      column[4 * k + 1].part[i] = _mm256_permute2f128_pd(b, d, 0x20);
      column[4 * k + 2].part[i] = _mm256_permute2f128_pd(a, c, 0x31);
      column[4 * k + 3].part[i] = _mm256_permute2f128_pd(b, d, 0x31);
    }
  return column;
}
#else
inline std::array<Lane, 8> columns_of(const std::array<const double*, 8>& row) {
  std::array<Lane, 8> column;
  for (std::size_t k = 0; k < 8; ++k)
    column[k] = Lane::from([&](int l) { return row[static_cast<std::size_t>(l)][k]; });
  return column;
}
#endif
}  // namespace simd

// Lane l of column k is row[l][k]: eight rows of eight doubles, transposed.
inline std::array<Lane, 8> columns_of(const std::array<const double*, 8>& row) {
  return simd::columns_of(row);
}

}  // namespace pulvis
