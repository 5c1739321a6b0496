// Eight doubles worked on at once: one particle of a chunk (or one Gauss point of two edges) a lane.
//
// A Lane is one register of AVX-512, two of AVX2 or four of SSE2, whatever the translation unit is compiled
// for. It lies in memory alike in all three, and every operation gives the same bits. The same functions
// exist for plain doubles, so that a kernel written with them is tested as a scalar and run on lanes.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>

#include "engine/component.hpp"
#include "engine/register.hpp"

namespace pulvis {

namespace simd {
inline constexpr std::size_t registers = lane_count / register_lanes;
}

struct LaneMask {
  simd::Mask part[simd::registers];

  static LaneMask of(unsigned bits);  // bit l: lane l
  unsigned bits() const;
  bool operator[](int l) const { return (bits() >> l & 1) != 0; }
};

struct alignas(64) Lane {
  simd::Register part[simd::registers];

  Lane() = default;  // as a double: Lane{} is zero, a plain declaration nothing yet
  Lane(double all) {
    for (auto& p : part) p = simd::broadcast(all);
  }
  template <class Value>  // value(l) of lane l
  static Lane from(const Value& value) {
    std::array<double, lane_count> all;
    for (int l = 0; l < lane_count; ++l) all[static_cast<std::size_t>(l)] = value(l);
    return load(all.data());
  }
  static Lane load(const double* eight) {
    Lane a;
    for (std::size_t i = 0; i < simd::registers; ++i)
      a.part[i] = simd::load(eight + i * simd::register_lanes);
    return a;
  }
  void store(double* eight) const {
    for (std::size_t i = 0; i < simd::registers; ++i)
      simd::store(eight + i * simd::register_lanes, part[i]);
  }
  // For code that is seldom run: it goes through memory.
  double& operator[](int l) { return reinterpret_cast<double*>(this)[l]; }
  double operator[](int l) const { return reinterpret_cast<const double*>(this)[l]; }
};
static_assert(sizeof(Lane) == lane_count * sizeof(double));

namespace simd {
template <class F>
Lane each(const F& f) {
  Lane result;
  for (std::size_t i = 0; i < registers; ++i) result.part[i] = f(i);
  return result;
}
template <class F>
LaneMask each_mask(const F& f) {
  LaneMask result;
  for (std::size_t i = 0; i < registers; ++i) result.part[i] = f(i);
  return result;
}
}  // namespace simd

// ---- arithmetic ------------------------------------------------------------------------------------
inline Lane operator+(const Lane& a, const Lane& b) {
  return simd::each([&](std::size_t i) { return a.part[i] + b.part[i]; });
}
inline Lane operator-(const Lane& a, const Lane& b) {
  return simd::each([&](std::size_t i) { return a.part[i] - b.part[i]; });
}
inline Lane operator*(const Lane& a, const Lane& b) {
  return simd::each([&](std::size_t i) { return a.part[i] * b.part[i]; });
}
inline Lane operator/(const Lane& a, const Lane& b) {
  return simd::each([&](std::size_t i) { return a.part[i] / b.part[i]; });
}
inline Lane operator-(const Lane& a) {
  return simd::each([&](std::size_t i) { return -a.part[i]; });
}
inline Lane& operator+=(Lane& a, const Lane& b) { return a = a + b; }
inline Lane& operator-=(Lane& a, const Lane& b) { return a = a - b; }
inline Lane& operator*=(Lane& a, const Lane& b) { return a = a * b; }

// a b + c, rounded once. Contraction is off for the whole build, so this is the only way to get one: the
// compilers cannot differ.
inline double fma(double a, double b, double c) { return std::fma(a, b, c); }
inline Lane fused(const Lane& a, const Lane& b, const Lane& c) {
  return simd::each([&](std::size_t i) { return simd::fma(a.part[i], b.part[i], c.part[i]); });
}
template <class A, class B, class C>
requires(std::is_same_v<A, Lane> || std::is_same_v<B, Lane> || std::is_same_v<C, Lane>) Lane
    fma(const A& a, const B& b, const C& c) {
  return fused(a, b, c);
}

inline double sqrt(double a) { return std::sqrt(a); }
inline Lane sqrt(const Lane& a) {
  return simd::each([&](std::size_t i) { return simd::sqrt(a.part[i]); });
}

// As std::min and std::max do it, so that a NaN in `a` stays one.
inline double min(double a, double b) { return std::min(a, b); }
inline double max(double a, double b) { return std::max(a, b); }
inline Lane min(const Lane& a, const Lane& b) {
  return simd::each([&](std::size_t i) { return simd::lesser(b.part[i], a.part[i]); });
}
inline Lane max(const Lane& a, const Lane& b) {
  return simd::each([&](std::size_t i) { return simd::greater(b.part[i], a.part[i]); });
}
inline double abs(double a) { return std::abs(a); }
inline Lane abs(const Lane& a) { return max(a, -a); }

// ---- comparison and choice -----------------------------------------------------------------------
inline LaneMask operator<(const Lane& a, const Lane& b) {
  return simd::each_mask([&](std::size_t i) { return simd::less(a.part[i], b.part[i]); });
}
inline LaneMask operator<=(const Lane& a, const Lane& b) {
  return simd::each_mask([&](std::size_t i) { return simd::less_or_equal(a.part[i], b.part[i]); });
}
inline LaneMask operator>(const Lane& a, const Lane& b) { return b < a; }
inline LaneMask operator>=(const Lane& a, const Lane& b) { return b <= a; }
inline LaneMask operator==(const Lane& a, const Lane& b) {
  return simd::each_mask([&](std::size_t i) { return simd::equal(a.part[i], b.part[i]); });
}
inline LaneMask operator&(const LaneMask& a, const LaneMask& b) {
  return simd::each_mask([&](std::size_t i) { return simd::Mask(a.part[i] & b.part[i]); });
}
inline LaneMask operator|(const LaneMask& a, const LaneMask& b) {
  return simd::each_mask([&](std::size_t i) { return simd::Mask(a.part[i] | b.part[i]); });
}
inline LaneMask operator~(const LaneMask& a) {
  return simd::each_mask([&](std::size_t i) { return simd::opposite(a.part[i]); });
}

inline unsigned LaneMask::bits() const {
  unsigned all = 0;
  for (std::size_t i = 0; i < simd::registers; ++i)
    all |= simd::bits(part[i]) << (i * simd::register_lanes);
  return all;
}
inline LaneMask LaneMask::of(unsigned bits) {
  return simd::each_mask(
      [&](std::size_t i) { return simd::mask_of(bits >> (i * simd::register_lanes)); });
}
inline bool any(const LaneMask& mask) { return mask.bits() != 0; }
inline bool all(const LaneMask& mask) { return mask.bits() == (1U << lane_count) - 1; }
inline bool any(bool mask) { return mask; }
inline bool all(bool mask) { return mask; }

inline double select(bool mask, double yes, double no) { return mask ? yes : no; }
inline Lane select(const LaneMask& mask, const Lane& yes, const Lane& no) {
  return simd::each(
      [&](std::size_t i) { return simd::select(mask.part[i], yes.part[i], no.part[i]); });
}

}  // namespace pulvis
