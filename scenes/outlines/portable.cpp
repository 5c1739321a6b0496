#include "scenes/outlines/portable.hpp"

#include <numbers>

namespace pulvis::portable {

// Phi(z) = 1/2 + phi(z) (z + z^3/3 + z^5/15 + ...), all terms have the same sign (Marsaglia 2004).
double normal_probability(double z) {
  if (z > 8) return 1;
  if (z < -8) return 0;
  double term = z, sum = z;
  for (int k = 3; k < 400 && sum + term != sum; k += 2) {
    term *= z * z / k;
    sum += term;
  }
  return 0.5 + sum * portable::exp(-z * z / 2) / std::sqrt(2 * std::numbers::pi);
}

double normal_quantile(double p) {
  double low = -8, high = 8;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (normal_probability(middle) < p ? low : high) = middle;
  }
  return (low + high) / 2;
}

std::uint64_t Random::bits() {
  std::uint64_t z = (state_ += 0x9e3779b97f4a7c15U);
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
  return z ^ (z >> 31U);
}

double Random::uniform() { return static_cast<double>(bits() >> 11U) * 0x1p-53; }

std::uint64_t Random::below(std::uint64_t count) {
  const auto i = static_cast<std::uint64_t>(uniform() * static_cast<double>(count));
  return i < count ? i : count - 1;
}

// A point of the unit disc, drawn until it is not too near the centre, projected onto the circle.
V2 Random::direction() {
  for (;;) {
    const V2 p{between(-1, 1), between(-1, 1)};
    const double square = dot(p, p);
    if (square > 1e-4 && square <= 1) return (1 / std::sqrt(square)) * p;
  }
}

}  // namespace pulvis::portable
