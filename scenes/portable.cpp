#include "scenes/portable.hpp"

#include <numbers>

namespace pulvis::portable {
namespace {

using std::numbers::ln2;
using std::numbers::pi;

// For 0 <= t <= tan(pi/16), where twelve terms of Gregory's series are exact to the last place.
double small_arctangent(double t) {
  double sum = 0;
  for (int k = 12; k >= 0; --k) sum = 1.0 / (2 * k + 1) - t * t * sum;
  return t * sum;
}

// Of the turn (c, s) with 0 <= s <= c: two halvings, tan(a/2) = s / (1 + c).
double first_octant(double c, double s) {
  const double half = s / (1 + c);
  const double quarter = half / (1 + std::sqrt(1 + half * half));
  return 4 * small_arctangent(quarter);
}

}  // namespace

double angle_of(Turn turn) {
  const double c = std::abs(turn.c), s = std::abs(turn.s);
  const double acute = s <= c ? first_octant(c, s) : pi / 2 - first_octant(s, c);
  const double upper = turn.c >= 0 ? acute : pi - acute;
  return turn.s >= 0 ? upper : -upper;
}

// e^x = 2^k e^r with |r| <= ln 2 / 2.
double exponential(double x) {
  const double k = std::floor(x / ln2 + 0.5);
  const double r = x - k * ln2;
  double sum = 1;
  for (int n = 18; n >= 1; --n) sum = 1 + r / n * sum;
  return std::ldexp(sum, static_cast<int>(k));
}

// log(m 2^k) = k ln 2 + 2 artanh((m-1)/(m+1)) with m in [sqrt(1/2), sqrt 2).
double logarithm(double x) {
  int k = 0;
  double m = std::frexp(x, &k);
  if (m < std::numbers::sqrt2 / 2) {
    m *= 2;
    --k;
  }
  const double t = (m - 1) / (m + 1);
  double sum = 0;
  for (int n = 14; n >= 0; --n) sum = 1.0 / (2 * n + 1) + t * t * sum;
  return k * ln2 + 2 * t * sum;
}

// Phi(z) = 1/2 + phi(z) (z + z^3/3 + z^5/15 + ...), all terms of one sign (Marsaglia 2004).
double normal_probability(double z) {
  if (z > 8) return 1;
  if (z < -8) return 0;
  double term = z, sum = z;
  for (int k = 3; k < 400 && sum + term != sum; k += 2) {
    term *= z * z / k;
    sum += term;
  }
  return 0.5 + sum * exponential(-z * z / 2) / std::sqrt(2 * pi);
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

// A point of the unit disc, drawn until it is not too near its centre, set on the circle.
V2 Random::direction() {
  for (;;) {
    const V2 p{between(-1, 1), between(-1, 1)};
    const double square = dot(p, p);
    if (square > 1e-4 && square <= 1) return (1 / std::sqrt(square)) * p;
  }
}

}  // namespace pulvis::portable
