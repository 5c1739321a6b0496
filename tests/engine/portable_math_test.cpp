// Functions that have the same bits everywhere: near the true value, and these very bits on this machine too.
#include "engine/portable_math.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <string>

#include "engine/files/xxh3.hpp"

namespace pulvis {
namespace {

using Arguments = std::function<std::array<double, 2>()>;

// Bits of a generator that the standard defines; no library's logarithm has a part in the arguments.
std::mt19937_64& bits() {
  static std::mt19937_64 generator(1);
  return generator;
}
double uniform(double low, double high) {
  return low + (high - low) * static_cast<double>(bits()() >> 11U) * 0x1p-53;
}
double magnitude(int minimum, int maximum) {  // between powers of two
  const int exponent =
      minimum + static_cast<int>(bits()() % static_cast<unsigned>(maximum - minimum));
  return std::ldexp(uniform(1, 2), exponent);
}
double signed_magnitude(int minimum, int maximum) {
  const double sign = bits()() % 2 == 0 ? 1 : -1;
  return sign * magnitude(minimum, maximum);
}

struct Case {
  std::string name;
  Arguments arguments;
  std::function<double(double, double)> ours;
  std::function<long double(long double, long double)> exact;  // eleven bits more
  double units = 1;                                            // in the last place
  std::uint64_t hash = 0;                                      // of all that came out
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

Arguments one(const std::function<double()>& x) {
  return [x] { return std::array{x(), 0.0}; };
}

constexpr auto sine = [](double x, double) { return portable::sin(x); };
constexpr auto cosine = [](double x, double) { return portable::cos(x); };
constexpr auto tangent = [](double x, double) { return portable::tan(x); };
constexpr auto exponential = [](double x, double) { return portable::exp(x); };
constexpr auto logarithm = [](double x, double) { return portable::log(x); };
constexpr auto power = [](double x, double y) { return portable::pow(x, y); };
constexpr auto exact_sine = [](long double x, long double) { return std::sin(x); };
constexpr auto exact_cosine = [](long double x, long double) { return std::cos(x); };
constexpr auto exact_tangent = [](long double x, long double) { return std::tan(x); };
constexpr auto exact_exponential = [](long double x, long double) { return std::exp(x); };
constexpr auto exact_logarithm = [](long double x, long double) { return std::log(x); };
constexpr auto exact_power = [](long double x, long double y) { return std::pow(x, y); };

std::vector<Case> cases() {
  const auto small = one([] { return uniform(-7, 7); });
  const auto wide = one([] { return signed_magnitude(-40, 50); });
  const auto positive = one([] { return magnitude(-1000, 1000); });
  const auto near_one = one([] { return uniform(0.4, 2.5); });
  const Arguments plane = [] { return std::array{uniform(-1, 1), uniform(-1, 1)}; };
  const Arguments far = [] {
    return std::array{signed_magnitude(-60, 60), signed_magnitude(-60, 60)};
  };
  return {
      {"Sine", small, sine, exact_sine, 1, 0xf672cdd798de4fccU},
      {"SineOfAny", wide, sine, exact_sine, 1, 0xb096389ae159ef23U},
      {"Cosine", small, cosine, exact_cosine, 1, 0x2adda781672f72a4U},
      {"CosineOfAny", wide, cosine, exact_cosine, 1, 0x510df7fbddf5e37bU},
      {"Tangent", small, tangent, exact_tangent, 1, 0xa8eeb85928096002U},
      {"TangentOfAny", wide, tangent, exact_tangent, 1, 0x59e5a83184461fc7U},
      {"ArcCosine", plane, [](double x, double) { return portable::acos(x); },
       [](long double x, long double) { return std::acos(x); }, 1.5, 0x722b36fbabaa576aU},
      {"ArcTangent", wide, [](double x, double) { return portable::atan(x); },
       [](long double x, long double) { return std::atan(x); }, 1, 0x87c16f27860a92bU},
      {"Angle", plane, [](double x, double y) { return portable::atan2(y, x); },
       [](long double x, long double y) { return std::atan2(y, x); }, 1, 0xf88805010608484dU},
      {"AngleOfAny", far, [](double x, double y) { return portable::atan2(y, x); },
       [](long double x, long double y) { return std::atan2(y, x); }, 1, 0xd0b57a29f3159952U},
      {"Exponential", one([] { return uniform(-708, 709); }), exponential, exact_exponential, 1,
       0xd1579de8cf29e667U},
      {"ExponentialOfSmall", one([] { return signed_magnitude(-60, 3); }), exponential,
       exact_exponential, 1, 0x44206cde593576c8U},
      {"Logarithm", positive, logarithm, exact_logarithm, 1, 0xcad639874b001560U},
      {"LogarithmNearOne", near_one, logarithm, exact_logarithm, 1, 0xcbd5954d5e80f5b2U},
      {"Power",
       [] {
         return std::array{magnitude(-3, 3), uniform(-200, 200)};
       },
       power, exact_power, 1, 0xfd78b5c5c9714a28U},
      {"PowerOfAny",
       [] {
         return std::array{magnitude(-300, 300), uniform(-3, 3)};
       },
       power, exact_power, 1, 0x254566ae12c67fecU},
      {"CubeRoot", one([] { return signed_magnitude(-1000, 1000); }),
       [](double x, double) { return portable::cbrt(x); },
       [](long double x, long double) { return std::cbrt(x); }, 1, 0x92b3b4be207bbd1eU},
      {"Length", far, [](double x, double y) { return portable::hypot(x, y); },
       [](long double x, long double y) { return std::hypot(x, y); }, 1, 0x7301125fac5b282fU},
      {"LengthOfAny",
       [] {
         return std::array{magnitude(-1000, 1000), magnitude(-1000, 1000)};
       },
       [](double x, double y) { return portable::hypot(x, y); },
       [](long double x, long double y) { return std::hypot(x, y); }, 1, 0xb80645bcbb339cc8U},
  };
}

class PortableMath : public testing::TestWithParam<Case> {
 protected:
  static constexpr int draws = 50000;
  static double last_place(double x) {
    return std::nextafter(std::abs(x), std::numeric_limits<double>::infinity()) - std::abs(x);
  }
};

TEST_P(PortableMath, IsWithinAUnitInTheLastPlace) {
  bits().seed(1);
  double worst = 0;
  std::array<double, 2> at{};
  for (int i = 0; i < draws; ++i) {
    const auto x = GetParam().arguments();
    const long double exact = GetParam().exact(x[0], x[1]);
    const double here = static_cast<double>(exact);
    if (!(std::abs(here) > std::numeric_limits<double>::min())) continue;
    const double error = static_cast<double>(
        std::abs(static_cast<long double>(GetParam().ours(x[0], x[1])) - exact) / last_place(here));
    if (error <= worst) continue;
    worst = error;
    at = x;
  }
  EXPECT_LE(worst, GetParam().units) << "at " << at[0] << ", " << at[1];
  EXPECT_GT(worst, 0.4);  // of something
}

// Recorded on an AMD EPYC with FMA by g++ 12 -O3. The first test says that they are right, this one that they
// are these wherever it runs.
TEST_P(PortableMath, HasTheSameBitsEverywhere) {
  bits().seed(2);
  Xxh3 all;
  for (int i = 0; i < draws; ++i) {
    const auto x = GetParam().arguments();
    const double here = GetParam().ours(x[0], x[1]);
    all.add(std::as_bytes(std::span(&here, 1)));
  }
  EXPECT_EQ(all.value(), GetParam().hash) << std::hex << all.value();
}

INSTANTIATE_TEST_SUITE_P(Functions, PortableMath, testing::ValuesIn(cases()),
                         [](const auto& test) { return test.param.name; });

TEST(PortableMathEnds, AreThoseOfTheLibrary) {
  constexpr double infinity = std::numeric_limits<double>::infinity(), pi = std::numbers::pi;
  for (const double x : {0.0, -0.0, 1.0, -1.0, 3.0, -3.0})
    for (const double y : {0.0, -0.0, 2.0, -2.0}) {
      EXPECT_EQ(portable::atan2(y, x), std::atan2(y, x)) << y << " " << x;
      EXPECT_EQ(std::signbit(portable::atan2(y, x)), std::signbit(std::atan2(y, x)));
      EXPECT_EQ(portable::hypot(x, y), std::hypot(x, y));
    }
  EXPECT_EQ(portable::sin(0), 0);
  EXPECT_EQ(portable::cos(0), 1);
  EXPECT_EQ(portable::acos(-1), pi);
  EXPECT_EQ(portable::acos(1), 0);
  EXPECT_EQ(portable::cbrt(0), 0);
  EXPECT_EQ(portable::log(1), 0);
  EXPECT_EQ(portable::exp(0), 1);
  EXPECT_EQ(portable::exp(1000), infinity);
  EXPECT_EQ(portable::exp(-1000), 0);
  EXPECT_EQ(portable::pow(0, 2), 0);
  EXPECT_EQ(portable::pow(0, -2), infinity);
  EXPECT_EQ(portable::pow(0, 0), 1);
  EXPECT_EQ(portable::pow(1, 1e300), 1);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double value : {portable::exp(nan), portable::sin(nan), portable::cos(1e300),
                             portable::pow(-1, 2), portable::atan2(nan, 1), portable::atan2(1, nan),
                             portable::hypot(nan, 1), portable::hypot(1, nan), portable::log(nan),
                             portable::log(-1), portable::cbrt(nan), portable::pow(nan, 2)})
    EXPECT_TRUE(std::isnan(value));
  EXPECT_EQ(portable::log(0), -infinity);
}

TEST(PortableMathEnds, WhatIsExactComesOutSo) {
  for (int i = 1; i < 200; ++i) {
    EXPECT_EQ(portable::pow(i, 2), i * i);
    EXPECT_EQ(portable::pow(i * i, 0.5), i);
    EXPECT_EQ(portable::cbrt(i * i * i), i);
    EXPECT_EQ(portable::hypot(3 * i, 4 * i), 5 * i);
    EXPECT_EQ(portable::pow(0.1 * i, 1), 0.1 * i);
  }
}

TEST(PortableMathEnds, LogGammaOfFactorials) {
  long double factorial = 1;
  for (int n = 1; n < 20; ++n) {
    EXPECT_NEAR(portable::log_gamma(n), static_cast<double>(std::log(factorial)), 4e-14) << n;
    factorial *= n;
  }
  EXPECT_NEAR(portable::log_gamma(1.5), 0.5 * std::log(std::numbers::pi) - std::log(2), 2e-14);
}

}  // namespace
}  // namespace pulvis
