// Eight doubles processed together: one particle of a chunk (or one Gauss point of two edges) per lane.
//
// A Lane is one AVX-512 register, two AVX2 registers or four SSE2 registers, whatever the translation unit is compiled
// for. Its memory layout is the same in all three, and every operation gives the same bits. The same functions
// exist for plain doubles, so a kernel written with them can be tested with scalars and run with lanes.
//
// A Packet is the part of a Lane in one register. Kernels with many intermediate values process one at a time,
// so that these values stay in registers (PartView in engine/access.hpp).
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

// One boolean per lane.
template <std::size_t Registers>
struct PackMask {
  static constexpr unsigned all_bits = (1U << Registers * simd::register_lanes) - 1;
  simd::Mask part[Registers];

  template <class F>
  static PackMask each(const F& f) {
    PackMask result;
    for (std::size_t i = 0; i < Registers; ++i) result.part[i] = f(i);
    return result;
  }
  static PackMask of(unsigned bits) {  // bit l: lane l
    return each([&](std::size_t i) { return simd::mask_of(bits >> (i * simd::register_lanes)); });
  }
  unsigned bits() const {
    unsigned all = 0;
    for (std::size_t i = 0; i < Registers; ++i)
      all |= simd::bits(part[i]) << (i * simd::register_lanes);
    return all;
  }
  bool operator[](int l) const { return (bits() >> l & 1) != 0; }

  friend PackMask operator&(const PackMask& a, const PackMask& b) {
    return each([&](std::size_t i) { return simd::Mask(a.part[i] & b.part[i]); });
  }
  friend PackMask operator|(const PackMask& a, const PackMask& b) {
    return each([&](std::size_t i) { return simd::Mask(a.part[i] | b.part[i]); });
  }
  friend PackMask operator~(const PackMask& a) {
    return each([&](std::size_t i) { return simd::opposite(a.part[i]); });
  }
  friend bool any(const PackMask& mask) { return mask.bits() != 0; }
  friend bool all(const PackMask& mask) { return mask.bits() == all_bits; }
};

template <std::size_t Registers>
struct alignas(Registers * sizeof(simd::Register)) Pack {
  using Mask = PackMask<Registers>;
  static constexpr std::size_t size = Registers * simd::register_lanes;
  simd::Register part[Registers];

  Pack() = default;  // as for double: Lane{} is zero, a plain declaration is uninitialised
  Pack(double all) {
    for (auto& p : part) p = simd::broadcast(all);
  }
  template <class Value>  // value(l) for lane l
  static Pack from(const Value& value) {
    std::array<double, size> all;
    for (std::size_t l = 0; l < size; ++l) all[l] = value(static_cast<int>(l));
    return load(all.data());
  }
  static Pack load(const double* from) {
    return each([&](std::size_t i) { return simd::load(from + i * simd::register_lanes); });
  }
  void store(double* to) const {
    for (std::size_t i = 0; i < Registers; ++i) simd::store(to + i * simd::register_lanes, part[i]);
  }
  // For code that rarely runs: it goes through memory.
  double& operator[](int l) { return reinterpret_cast<double*>(this)[l]; }
  double operator[](int l) const { return reinterpret_cast<const double*>(this)[l]; }

  // ---- arithmetic ----------------------------------------------------------------------------------
  template <class F>
  static Pack each(const F& f) {
    Pack result;
    for (std::size_t i = 0; i < Registers; ++i) result.part[i] = f(i);
    return result;
  }
  friend Pack operator+(const Pack& a, const Pack& b) {
    return each([&](std::size_t i) { return a.part[i] + b.part[i]; });
  }
  friend Pack operator-(const Pack& a, const Pack& b) {
    return each([&](std::size_t i) { return a.part[i] - b.part[i]; });
  }
  friend Pack operator*(const Pack& a, const Pack& b) {
    return each([&](std::size_t i) { return a.part[i] * b.part[i]; });
  }
  friend Pack operator/(const Pack& a, const Pack& b) {
    return each([&](std::size_t i) { return a.part[i] / b.part[i]; });
  }
  friend Pack operator-(const Pack& a) {
    return each([&](std::size_t i) { return -a.part[i]; });
  }
  friend Pack& operator+=(Pack& a, const Pack& b) { return a = a + b; }
  friend Pack& operator-=(Pack& a, const Pack& b) { return a = a - b; }
  friend Pack& operator*=(Pack& a, const Pack& b) { return a = a * b; }

  // a b + c, rounded once; see fma.
  static Pack fused(const Pack& a, const Pack& b, const Pack& c) {
    return each([&](std::size_t i) { return simd::fma(a.part[i], b.part[i], c.part[i]); });
  }
  friend Pack sqrt(const Pack& a) {
    return each([&](std::size_t i) { return simd::sqrt(a.part[i]); });
  }
  friend Pack whole(const Pack& a) {  // rounded towards zero
    return each([&](std::size_t i) { return simd::whole(a.part[i]); });
  }
  friend Pack min(const Pack& a, const Pack& b) {
    return each([&](std::size_t i) { return simd::lesser(b.part[i], a.part[i]); });
  }
  friend Pack max(const Pack& a, const Pack& b) {
    return each([&](std::size_t i) { return simd::greater(b.part[i], a.part[i]); });
  }
  friend Pack abs(const Pack& a) { return max(a, -a); }

  // ---- comparison and selection --------------------------------------------------------------------
  friend Mask operator<(const Pack& a, const Pack& b) {
    return Mask::each([&](std::size_t i) { return simd::less(a.part[i], b.part[i]); });
  }
  friend Mask operator<=(const Pack& a, const Pack& b) {
    return Mask::each([&](std::size_t i) { return simd::less_or_equal(a.part[i], b.part[i]); });
  }
  friend Mask operator>(const Pack& a, const Pack& b) { return b < a; }
  friend Mask operator>=(const Pack& a, const Pack& b) { return b <= a; }
  friend Mask operator==(const Pack& a, const Pack& b) {
    return Mask::each([&](std::size_t i) { return simd::equal(a.part[i], b.part[i]); });
  }
  friend Pack select(const Mask& mask, const Pack& yes, const Pack& no) {
    return each([&](std::size_t i) { return simd::select(mask.part[i], yes.part[i], no.part[i]); });
  }
};

using Lane = Pack<simd::registers>;
using LaneMask = Lane::Mask;
using Packet = Pack<1>;
static_assert(sizeof(Lane) == lane_count * sizeof(double) && alignof(Lane) == sizeof(Lane));

template <class T>
inline constexpr bool is_pack = false;
template <std::size_t Registers>
inline constexpr bool is_pack<Pack<Registers>> = true;

// a b + c, rounded once. FP contraction is off for the whole build, so this is the only way to get an FMA:
// results do not depend on the compiler.
inline double fma(double a, double b, double c) { return std::fma(a, b, c); }
template <class A, class B, class C>
requires(is_pack<A> || is_pack<B> || is_pack<C>) auto fma(const A& a, const B& b, const C& c) {
  using AB = std::conditional_t<is_pack<A>, A, B>;
  return std::conditional_t<is_pack<AB>, AB, C>::fused(a, b, c);
}

inline double sqrt(double a) { return std::sqrt(a); }

// Same semantics as std::min and std::max, so that a NaN in `a` is propagated.
inline double min(double a, double b) { return std::min(a, b); }
inline double max(double a, double b) { return std::max(a, b); }
inline double abs(double a) { return std::abs(a); }

inline bool any(bool mask) { return mask; }
inline bool all(bool mask) { return mask; }
inline double select(bool mask, double yes, double no) { return mask ? yes : no; }

// The part of a lane held in register i.
inline constexpr int parts_of_a_lane = simd::registers;
inline Packet part_of(const Lane& lane, int i) {
  Packet packet;
  packet.part[0] = lane.part[i];
  return packet;
}

}  // namespace pulvis
