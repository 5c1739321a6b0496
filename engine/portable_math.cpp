// Method: an argument is reduced to a range where a short power series is exact; rounding errors are carried along
// as the low part of a Pair. Error-free sums and products: Knuth (1969), Dekker (1971); reduction by pi/2 and ln 2
// in parts: Cody and Waite (1980).
#include "engine/portable_math.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace pulvis::portable {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

// The exact sum of two numbers.
struct Pair {
  double high = 0, low = 0;
  double value() const { return high + low; }
};

constexpr Pair half_pi{0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};
constexpr double half_pi_rest = -0x1.f1976b7ed8fbcp-110;
constexpr double ln2_high = 0x1.62e42fee00000p-1;  // exact times an integer below 2^20
constexpr double ln2_low = 0x1.a39ef35793c76p-33;

Pair sum_of(double a, double b) {
  const double s = a + b, of_b = s - a;
  return {s, (a - (s - of_b)) + (b - of_b)};
}
Pair sum_of_larger(double a, double b) {  // |a| >= |b|
  const double s = a + b;
  return {s, b - (s - a)};
}
Pair product_of(double a, double b) {
  const double p = a * b;
  return {p, std::fma(a, b, -p)};
}
Pair times(Pair a, Pair b) {
  const Pair p = product_of(a.high, b.high);
  return sum_of_larger(p.high, p.low + (a.high * b.low + a.low * b.high));
}
double quotient(Pair a, Pair b) {
  const double q = a.high / b.high;
  return q + ((std::fma(-q, b.high, a.high) + a.low) - q * b.low) / b.high;
}

// x 2^k, like std::ldexp; a product if the power is a normal number.
double scaled(double x, int k) {
  if (k < -1022 || k > 1023) return std::ldexp(x, k);
  return x * std::bit_cast<double>(static_cast<std::uint64_t>(k + 1023) << 52U);
}

// c[0] + z (c[1] + z (c[2] + ...))
template <std::size_t N>
double series(double z, const std::array<double, N>& c) {
  double sum = c[N - 1];
  for (std::size_t i = N - 1; i-- > 0;) sum = c[i] + z * sum;
  return sum;
}

double whole(double x) { return std::floor(x + 0.5); }

// ---- sine, cosine, tangent ----

struct Reduced {
  Pair angle;                 // in [-pi/4, pi/4]
  std::int64_t quarters = 0;  // plus this many times pi/2
};

Reduced reduced(double x) {
  const double k = whole(x / half_pi.high);
  const Pair p = product_of(k, half_pi.high), q = product_of(k, half_pi.low);
  const Pair a = sum_of(x, -p.high), b = sum_of(a.high, -p.low), c = sum_of(b.high, -q.high);
  const double rest = ((a.low + b.low) + c.low) - (q.low + k * half_pi_rest);
  return {sum_of(c.high, rest), static_cast<std::int64_t>(k)};
}

// Taylor series up to power 19.
Pair small_sine(Pair x) {
  static constexpr std::array c{-1 / 6.0,          1 / 120.0,          -1 / 5040.0,
                                1 / 362880.0,      -1 / 39916800.0,    1 / 6227020800.0,
                                -1 / 1307674368e3, 1 / 355687428096e3, -1 / 121645100408832e3};
  const double z = x.high * x.high;
  return sum_of_larger(x.high, x.high * z * series(z, c) + x.low * (1 - 0.5 * z));
}
Pair small_cosine(Pair x) {
  static constexpr std::array c{1 / 24.0,          -1 / 720.0,          1 / 40320.0,
                                -1 / 3628800.0,    1 / 479001600.0,     -1 / 87178291200.0,
                                1 / 20922789888e3, -1 / 6402373705728e3};
  const Pair z = product_of(x.high, x.high);
  const Pair s = sum_of_larger(1, -0.5 * z.high);
  const double rest = z.high * z.high * series(z.high, c) - 0.5 * z.low - x.high * x.low;
  return sum_of_larger(s.high, s.low + rest);
}

// The sine of the angle plus this number of quarter turns: 1 gives the cosine.
Pair shifted_sine(double x, std::uint64_t quarters) {
  if (!(std::abs(x) < 0x1p50)) return {nan, nan};
  const Reduced r = reduced(x);
  const std::uint64_t q = (static_cast<std::uint64_t>(r.quarters) + quarters) % 4;
  const Pair value = q % 2 == 0 ? small_sine(r.angle) : small_cosine(r.angle);
  return q < 2 ? value : Pair{-value.high, -value.low};
}

// ---- arctangent ----

// Approximately, of v/u, 0 <= v <= u: two halvings, tan(a/2) = tan a / (1 + sqrt(1 + tan^2 a)), Gregory's series.
double nearly_arctangent(double t) {
  for (int i = 0; i < 2; ++i) t /= 1 + std::sqrt(1 + t * t);
  double sum = 0;
  for (int k = 12; k >= 0; --k) sum = 1.0 / (2 * k + 1) - t * t * sum;
  return 4 * t * sum;
}

// The angle a of the vector (u, v) is near a0; the vector rotated back by a0 has the angle a - a0.
Pair acute_angle(double u, double v) {
  const double a0 = nearly_arctangent(v / u);
  const Pair s = small_sine({a0, 0}), c = small_cosine({a0, 0});
  const Pair up = product_of(v, c.high), down = product_of(u, s.high);
  const double across = (up.high - down.high) + ((up.low - down.low) + (v * c.low - u * s.low));
  return {a0, across / (u * c.high + v * s.high)};
}

Pair difference(Pair a, Pair b) {
  const Pair s = sum_of(a.high, -b.high);
  return {s.high, s.low + (a.low - b.low)};
}

// ---- exponential and logarithm ----

// e^x = 2^k e^r with |r| <= ln 2 / 2; Taylor series up to power 15.
double exponential(Pair x) {
  if (!(x.high < 710)) return x.high > 0 ? infinity : nan;
  if (x.high < -746) return 0;
  static constexpr std::array c{0.5,
                                1 / 6.0,
                                1 / 24.0,
                                1 / 120.0,
                                1 / 720.0,
                                1 / 5040.0,
                                1 / 40320.0,
                                1 / 362880.0,
                                1 / 3628800.0,
                                1 / 39916800.0,
                                1 / 479001600.0,
                                1 / 6227020800.0,
                                1 / 87178291200.0,
                                1 / 1307674368e3};
  const double k = whole(x.high / std::numbers::ln2);
  const Pair r = sum_of(x.high - k * ln2_high, x.low - k * ln2_low);
  const Pair s = sum_of_larger(1, r.high);
  const double rest = s.low + (r.low + r.low * r.high + r.high * r.high * series(r.high, c));
  return scaled(s.high + rest, static_cast<int>(k));
}

struct Mantissa {
  double m = 1;  // in [sqrt(1/2), sqrt 2)
  int k = 0;     // x = m 2^k
};

Mantissa mantissa(double x) {
  Mantissa of;
  of.m = std::frexp(x, &of.k);
  if (of.m < std::numbers::sqrt2 / 2) {
    of.m *= 2;
    --of.k;
  }
  return of;
}

// log m = 2 artanh s = 2 (s + s^3/3 + ...), s = (m-1)/(m+1); from s^5 on.
double artanh_rest(double s, double z) {
  static constexpr std::array c{1 / 5.0,  1 / 7.0,  1 / 9.0,  1 / 11.0, 1 / 13.0,
                                1 / 15.0, 1 / 17.0, 1 / 19.0, 1 / 21.0};
  return s * z * z * series(z, c);
}

Pair logarithm(double x) {
  const auto [m, k] = mantissa(x);
  const double f = m - 1;
  const Pair d = sum_of_larger(2, f);
  const double q = f / d.high;
  const Pair s = sum_of_larger(q, (std::fma(-q, d.high, f) - q * d.low) / d.high);
  const Pair cube = times(times(s, s), s), third = times(cube, {1 / 3.0, 0x1.5555555555555p-56});
  const Pair first = sum_of_larger(s.high, third.high);
  const double rest = first.low + (s.low + third.low) + artanh_rest(s.high, s.high * s.high);
  const Pair of_m = sum_of_larger(2 * first.high, 2 * rest),
             whole_part = sum_of(k * ln2_high, of_m.high);
  return sum_of_larger(whole_part.high, whole_part.low + (of_m.low + k * ln2_low));
}

}  // namespace

double sin(double x) { return shifted_sine(x, 0).value(); }
double cos(double x) { return shifted_sine(x, 1).value(); }
double tan(double x) { return quotient(shifted_sine(x, 0), shifted_sine(x, 1)); }

double acos(double x) { return atan2(std::sqrt((1 - x) * (1 + x)), x); }
double atan(double x) { return atan2(x, 1); }

double atan2(double y, double x) {
  if (std::isnan(x) || std::isnan(y)) return nan;
  const double maximum = std::max(std::abs(x), std::abs(y));
  if (maximum == 0) return std::copysign(std::signbit(x) ? std::numbers::pi : 0, y);
  int k = 0;
  std::frexp(maximum, &k);
  const double u = scaled(std::abs(x), -k), v = scaled(std::abs(y), -k);
  Pair angle = v <= u ? acute_angle(u, v) : difference(half_pi, acute_angle(v, u));
  if (std::signbit(x)) angle = difference({2 * half_pi.high, 2 * half_pi.low}, angle);
  return std::copysign(angle.value(), y);
}

double exp(double x) { return exponential({x, 0}); }

double log(double x) {
  if (x == 0) return -infinity;
  if (!(x > 0 && x < infinity)) return x > 0 ? x : nan;
  const auto [m, k] = mantissa(x);
  const double f = m - 1, s = f / (2 + f), z = s * s;
  // log m = f - s (f - 2 (s^2/3 + s^4/5 + ...)), where f is exact
  const double rest = s * (f - 2 * (z * (1 / 3.0) + artanh_rest(1, z)));
  const Pair whole_part = sum_of(k * ln2_high, f);
  return whole_part.high + (whole_part.low + (k * ln2_low - rest));
}

double pow(double x, double y) {
  if (y == 0 || x == 1) return 1;
  if (x == 0) return y > 0 ? 0 : infinity;
  if (!(x > 0)) return nan;
  const Pair log_x = logarithm(x), product = product_of(y, log_x.high);
  return exponential(sum_of_larger(product.high, product.low + y * log_x.low));
}

// For m in [1/8, 1): Newton's method, the last iteration with the exact residual.
double cbrt(double x) {
  if (x == 0) return x;
  int k = 0;
  double m = std::frexp(std::abs(x), &k);
  const int third = k > 0 ? (k + 2) / 3 : k / 3;
  m = scaled(m, k - 3 * third);
  double y = 0.4 + 0.64 * m;
  for (int i = 0; i < 6; ++i) y -= (y - m / (y * y)) / 3;
  const Pair square = product_of(y, y), cube = product_of(square.high, y);
  y -= ((cube.high - m) + (cube.low + square.low * y)) / (3 * square.high);
  return std::copysign(scaled(y, third), x);
}

double hypot(double x, double y) {
  if (std::isnan(x) || std::isnan(y)) return nan;
  double a = std::max(std::abs(x), std::abs(y)), b = std::min(std::abs(x), std::abs(y));
  if (b == 0) return a;
  int k = 0;
  if (a > 0x1p500 || b < 0x1p-400) {  // squares would overflow or underflow
    std::frexp(a, &k);
    a = scaled(a, -k);
    b = scaled(b, -k);
  }
  const Pair a2 = product_of(a, a), b2 = product_of(b, b), sum = sum_of_larger(a2.high, b2.high);
  const double h = std::sqrt(sum.high);
  const double rest = std::fma(-h, h, sum.high) + (sum.low + (a2.low + b2.low));
  return scaled(h + rest / (2 * h), k);
}

// Stirling's series, evaluated ten recurrence steps Gamma(x + 1) = x Gamma(x) higher.
double log_gamma(double x) {
  double product = 1;
  for (int i = 0; i < 10; ++i) product *= x++;
  static constexpr std::array c{1 / 12.0,   -1 / 360.0,      1 / 1260.0, -1 / 1680.0,
                                1 / 1188.0, -691 / 360360.0, 1 / 156.0};
  constexpr double half_log_2pi = 0x1.d67f1c864beb5p-1;
  return (x - 0.5) * log(x) - x + half_log_2pi + series(1 / (x * x), c) / x - log(product);
}

}  // namespace pulvis::portable
