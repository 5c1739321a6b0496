// Arithmetic for results that must be identical on every machine and with every compiler and math
// library, such as a random packing: after some thousand collisions one different last bit gives a different
// packing. Sums, products, quotients and square roots are rounded identically everywhere (IEEE 754); sines and
// exponentials of libraries are not (engine/portable_math.hpp has portable ones), nor are the distributions of
// <random>.
#pragma once

#include <cmath>
#include <cstdint>

#include "engine/portable_math.hpp"

namespace pulvis::portable {

struct V2 {
  double x = 0, y = 0;
  bool operator==(const V2&) const = default;
};
inline V2 operator+(V2 a, V2 b) { return {a.x + b.x, a.y + b.y}; }
inline V2 operator-(V2 a, V2 b) { return {a.x - b.x, a.y - b.y}; }
inline V2 operator*(double k, V2 a) { return {k * a.x, k * a.y}; }
inline double dot(V2 a, V2 b) { return a.x * b.x + a.y * b.y; }
inline double cross(V2 a, V2 b) { return a.x * b.y - a.y * b.x; }
inline double length(V2 a) { return std::sqrt(dot(a, a)); }

// A rotation, stored as its cosine and sine.
struct Turn {
  double c = 1, s = 0;
};
inline V2 operator*(Turn r, V2 a) { return {r.c * a.x - r.s * a.y, r.s * a.x + r.c * a.y}; }
inline V2 turned_back(Turn r, V2 a) { return {r.c * a.x + r.s * a.y, r.c * a.y - r.s * a.x}; }
// Rotated by a further 2 arctan(half): Cayley map, which needs no sine. For small angles `half` is half of it.
inline Turn turned(Turn r, double half) {
  const double d = 1 / (1 + half * half);
  const double c = (1 - half * half) * d, s = 2 * half * d;
  const Turn next{c * r.c - s * r.s, s * r.c + c * r.s};
  const double norm = 1 / std::sqrt(next.c * next.c + next.s * next.s);
  return {next.c * norm, next.s * norm};
}

double normal_probability(double z);  // P(Z <= z) of the standard normal distribution
double normal_quantile(double p);     // its inverse, 0 < p < 1

// SplitMix64 (Steele, Lea, Flood 2014).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t bits();
  double uniform();  // in [0, 1), 53 bits
  double between(double low, double high) { return low + (high - low) * uniform(); }
  std::uint64_t below(std::uint64_t count);  // 0 .. count - 1
  V2 direction();                            // of length 1

 private:
  std::uint64_t state_;
};

}  // namespace pulvis::portable
