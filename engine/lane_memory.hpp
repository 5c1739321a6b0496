// Lanes loaded from several places in memory: halves of four, and eight rows of eight.
#pragma once

#include "engine/lane.hpp"

namespace pulvis {

// The first four lanes from `low`, the last four from `high`.
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
#ifdef __AVX512F__
  Lane a;
  a.part[0] = _mm512_mask_broadcastsd_pd(_mm512_set1_pd(low), 0xf0, _mm_set_sd(high));
  return a;
#else
  const std::array<double, 4> a{low, low, low, low}, b{high, high, high, high};
  return load_halves(a.data(), b.data());
#endif
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

// The four lanes of one half of x and y, interleaved: x y x y ...
inline void store_pairs_of_half(const Lane& x, const Lane& y, int half, double* eight) {
#ifdef __AVX512F__
  const __m512i pairs = half == 0 ? _mm512_setr_epi64(0, 8, 1, 9, 2, 10, 3, 11)
                                  : _mm512_setr_epi64(4, 12, 5, 13, 6, 14, 7, 15);
  _mm512_storeu_pd(eight, _mm512_permutex2var_pd(x.part[0], pairs, y.part[0]));
#else
  std::array<double, 4> a, b;
  store_half(x, half, a.data());
  store_half(y, half, b.data());
  for (std::size_t i = 0; i < 4; ++i) {
    eight[2 * i] = a[i];
    eight[2 * i + 1] = b[i];
  }
#endif
}

// x and y of every lane as adjacent pairs, the pair of lane l at first + l apart.
inline void store_pairs(const Lane& x, const Lane& y, double* first, std::size_t apart) {
#ifdef __AVX512F__
  const __m512d even = _mm512_unpacklo_pd(x.part[0], y.part[0]);  // lanes 0 2 4 6
  const __m512d odd = _mm512_unpackhi_pd(x.part[0], y.part[0]);
  const auto put = [&](int l, __m128d pair) {
    _mm_storeu_pd(first + static_cast<std::size_t>(l) * apart, pair);
  };
  put(0, _mm512_castpd512_pd128(even)), put(1, _mm512_castpd512_pd128(odd));
  put(2, _mm512_extractf64x2_pd(even, 1)), put(3, _mm512_extractf64x2_pd(odd, 1));
  put(4, _mm512_extractf64x2_pd(even, 2)), put(5, _mm512_extractf64x2_pd(odd, 2));
  put(6, _mm512_extractf64x2_pd(even, 3)), put(7, _mm512_extractf64x2_pd(odd, 3));
#else
  for (int l = 0; l < lane_count; ++l) {
    double* pair = first + static_cast<std::size_t>(l) * apart;
    pair[0] = x[l];
    pair[1] = y[l];
  }
#endif
}

// x y x y x y x y
inline Lane repeat_pair(const double* xy) {
#if defined(__AVX512F__)
  Lane a;
  a.part[0] = _mm512_broadcast_f64x2(_mm_loadu_pd(xy));
  return a;
#elif defined(__AVX2__)
  Lane a;
  for (auto& part : a.part) part = _mm256_broadcast_pd(reinterpret_cast<const __m128d*>(xy));
  return a;
#else
  return Lane::from([xy](int l) { return xy[l % 2]; });
#endif
}

// (v0 + v1) + (v2 + v3) of both halves of `a` and `b`: the same order, and same bits, on every machine.
struct SumsOfHalves {
  std::array<double, 2> a, b;
};
inline SumsOfHalves sums_of_halves(const Lane& a, const Lane& b) {
  std::array<double, lane_count> s;
#if defined(__AVX512F__)
  const __m512d pairs = _mm512_unpacklo_pd(a.part[0], b.part[0]) +
                        _mm512_unpackhi_pd(a.part[0], b.part[0]);  // a01 b01 a23 b23, twice
  _mm512_storeu_pd(s.data(), pairs + _mm512_permutex_pd(pairs, 0x4e));
#elif defined(__AVX2__)
  for (std::size_t i = 0; i < 2; ++i) {
    const __m256d pairs = _mm256_hadd_pd(a.part[i], b.part[i]);
    _mm256_storeu_pd(s.data() + 4 * i, pairs + _mm256_permute4x64_pd(pairs, 0x4e));
  }
#else
  for (int i = 0; i < lane_count; i += 4) {
    s[static_cast<std::size_t>(i)] = (a[i] + a[i + 1]) + (a[i + 2] + a[i + 3]);
    s[static_cast<std::size_t>(i) + 1] = (b[i] + b[i + 1]) + (b[i + 2] + b[i + 3]);
  }
#endif
  return {{s[0], s[4]}, {s[1], s[5]}};
}

inline double min_of_half(const Lane& a, int half) {
  std::array<double, 4> v;
  store_half(a, half, v.data());
  return std::min(std::min(v[0], v[1]), std::min(v[2], v[3]));
}
inline double greatest_of_half(const Lane& a, int half) { return -min_of_half(-a, half); }

// Bit i: sixteen[i] <= limit.
inline unsigned at_most(const float* sixteen, float limit) {
#if defined(__AVX512F__)
  return _mm512_cmp_ps_mask(_mm512_loadu_ps(sixteen), _mm512_set1_ps(limit), _CMP_LE_OQ);
#elif defined(__AVX2__)
  const __m256 all = _mm256_set1_ps(limit);
  const auto half = [&](const float* eight) {
    return static_cast<unsigned>(
        _mm256_movemask_ps(_mm256_cmp_ps(_mm256_loadu_ps(eight), all, _CMP_LE_OQ)));
  };
  return half(sixteen) | half(sixteen + 8) << 8;
#else
  unsigned bits = 0;
  for (unsigned i = 0; i < 16; ++i) bits |= (sixteen[i] <= limit ? 1U : 0U) << i;
  return bits;
#endif
}

namespace simd {
#if defined(__AVX512F__)
// Loads put rows i and i + 4 into the two halves of a register; then both are transposed (4 x 4) at once.
template <std::size_t Count>
[[gnu::always_inline]] inline std::array<Lane, Count> columns_of(
    const std::array<const double*, 8>& row) {
  const __m512i low = _mm512_setr_epi64(0, 1, 8, 9, 4, 5, 12, 13);
  const __m512i high = _mm512_setr_epi64(2, 3, 10, 11, 6, 7, 14, 15);
  std::array<Lane, Count> column;
  for (std::size_t k = 0; k < Count; k += 4) {
    __m512d r[4];
    for (std::size_t i = 0; i < 4; ++i)
      r[i] = _mm512_mask_broadcast_f64x4(_mm512_castpd256_pd512(_mm256_loadu_pd(row[i] + k)), 0xf0,
                                         _mm256_loadu_pd(row[i + 4] + k));
    const __m512d a = _mm512_unpacklo_pd(r[0], r[1]), b = _mm512_unpackhi_pd(r[0], r[1]);
    const __m512d c = _mm512_unpacklo_pd(r[2], r[3]), d = _mm512_unpackhi_pd(r[2], r[3]);
    column[k].part[0] = _mm512_permutex2var_pd(a, low, c);
    column[k + 1].part[0] = _mm512_permutex2var_pd(b, low, d);
    column[k + 2].part[0] = _mm512_permutex2var_pd(a, high, c);
    column[k + 3].part[0] = _mm512_permutex2var_pd(b, high, d);
  }
  return column;
}
#elif defined(__AVX2__) && defined(__FMA__)
template <std::size_t Count>
[[gnu::always_inline]] inline std::array<Lane, Count> columns_of(
    const std::array<const double*, 8>& row) {
  std::array<Lane, Count> column;
  for (std::size_t i = 0; i < 2; ++i)              // rows 4 i ... + 3
    for (std::size_t k = 0; k < Count / 4; ++k) {  // columns 4 k ... + 3
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
template <std::size_t Count>
[[gnu::always_inline]] inline std::array<Lane, Count> columns_of(
    const std::array<const double*, 8>& row) {
  std::array<Lane, Count> column;
  for (std::size_t k = 0; k < Count; ++k)
    column[k] = Lane::from([&](int l) { return row[static_cast<std::size_t>(l)][k]; });
  return column;
}
#endif
}  // namespace simd

// Lane l of column k is row[l][k]: eight rows of eight doubles, or of four, transposed.
template <std::size_t Count = 8>
[[gnu::always_inline]] inline std::array<Lane, Count> columns_of(
    const std::array<const double*, 8>& row) {
  static_assert(Count == 4 || Count == 8);
  return simd::columns_of<Count>(row);
}

}  // namespace pulvis
