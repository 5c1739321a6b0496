// Random values with a fixed seed and comparison of bits, for the tests of the kernels.
#pragma once

#include <bit>
#include <cstdint>
#include <random>

#include "engine/lane.hpp"
#include "systems/body/element_kernel.hpp"

namespace pulvis::kernels {

// The same numbers on every machine and standard library.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double in(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  Lane lane(double low, double high) {
    Lane all{};
    for (int l = 0; l < lane_count; ++l) all[l] = in(low, high);
    return all;
  }

 private:
  std::mt19937_64 engine_;
};

inline std::uint64_t bits(double value) { return std::bit_cast<std::uint64_t>(value); }

inline Matrix2<double> rotation(double angle) {
  return {std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle)};
}

inline Matrix2<double> product(const Matrix2<double>& a, const Matrix2<double>& b) {
  return {a.xx * b.xx + a.xy * b.yx, a.xx * b.xy + a.xy * b.yy, a.yx * b.xx + a.yy * b.yx,
          a.yx * b.xy + a.yy * b.yy};
}

}  // namespace pulvis::kernels
