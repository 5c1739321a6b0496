// Sums that do not depend on their order, held against whole numbers of any length, rounded once.
#include "engine/ranks/exact_sum.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <bit>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "engine/instruction_set.hpp"

namespace pulvis {
namespace {

using Whole = boost::multiprecision::cpp_int;
using Limits = std::numeric_limits<double>;

constexpr int unit = -1074;  // exponent of the smallest double
constexpr int mantissa_bits = 53;

// In units of the smallest double.
Whole whole(double number) {
  int exponent = 0;
  const double fraction = std::frexp(number, &exponent);  // fraction 2^exponent
  const int shift = exponent - mantissa_bits - unit;
  const Whole mantissa(static_cast<std::int64_t>(std::ldexp(fraction, mantissa_bits)));
  return shift >= 0 ? Whole(mantissa << shift) : Whole(mantissa / (Whole(1) << -shift));
}

// To nearest, ties to even.
double rounded(Whole number) {
  const bool negative = number < 0;
  if (negative) number = -number;
  int dropped = 0;
  if (number != 0) dropped = std::max(0, static_cast<int>(msb(number)) + 1 - mantissa_bits);
  Whole kept = number >> dropped;
  const Whole twice = (number - (kept << dropped)) * 2, last = Whole(1) << dropped;
  if (twice > last || (twice == last && dropped > 0 && (kept & 1) == 1)) kept += 1;
  const double size = std::ldexp(kept.convert_to<double>(), dropped + unit);
  return negative ? -size : size;
}

double reference(const std::vector<double>& terms) {
  Whole sum = 0;
  for (const double term : terms) sum += whole(term);
  return rounded(sum);
}

double summed(const std::vector<double>& terms) {
  ExactSum sum;
  for (const double term : terms) sum.add(term);
  return sum.value();
}

// Dealt out to several sums, which are then added up as sums or, as ranks do it, number by number.
double summed_in_parts(const std::vector<double>& terms, std::size_t parts, bool by_numbers) {
  std::vector<ExactSum> sums(parts);
  for (std::size_t i = 0; i < terms.size(); ++i) sums[i * i % parts].add(terms[i]);
  if (!by_numbers) {
    ExactSum all;
    for (const ExactSum& sum : sums) all.add(sum);
    return all.value();
  }
  std::vector<std::int64_t> numbers(ExactSum::numbers);
  for (ExactSum& sum : sums)
    for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] += sum.carried()[i];
  return ExactSum::of(numbers).value();
}

::testing::Matcher<double> same_bits(double value) {
  return ::testing::ResultOf([](double x) { return std::bit_cast<std::uint64_t>(x); },
                             ::testing::Eq(std::bit_cast<std::uint64_t>(value)));
}

struct Draw {
  std::mt19937_64 random{20240607};
  std::size_t below(std::size_t limit) { return static_cast<std::size_t>(random() % limit); }

  // Of any bits but those of infinities and NaN, or of exponents within `spread` of `centre`.
  double any() {
    for (;;)
      if (const double number = std::bit_cast<double>(random()); std::isfinite(number))
        return number;
  }
  double near(int centre, int spread) {
    const double fraction = 1 + static_cast<double>(random() >> 12) * 0x1p-52;
    const int exponent =
        centre - spread + static_cast<int>(below(static_cast<std::size_t>(2 * spread + 1)));
    return std::ldexp(below(2) == 0 ? fraction : -fraction, exponent);
  }
  void shuffle(std::vector<double>& terms) { std::shuffle(terms.begin(), terms.end(), random); }
};

void expect_exact(std::vector<double> terms, Draw& draw) {
  const double right = reference(terms);
  for (int round = 0; round < 3; ++round) {
    EXPECT_THAT(summed(terms), same_bits(right));
    for (const std::size_t parts : {1, 2, 3, 7})
      for (const bool by_numbers : {false, true})
        EXPECT_THAT(summed_in_parts(terms, parts, by_numbers), same_bits(right));
    draw.shuffle(terms);
  }
}

TEST(ExactSum, TermsOfAllMagnitudesInAnyOrder) {
  Draw draw;
  for (int round = 0; round < 300; ++round) {
    std::vector<double> terms(1 + draw.below(200));
    for (double& term : terms) term = draw.any();
    expect_exact(terms, draw);
  }
}

// Where terms are of like size, every bit of each counts; near the smallest numbers the sum may be one of them.
TEST(ExactSum, TermsOfLikeMagnitude) {
  Draw draw;
  for (const int centre :
       {-1080, -1074, -1050, -1022, -1000, -990, -500, -1, 0, 31, 32, 33, 500, 900})
    for (const int spread : {0, 3, 40, 90})
      for (int round = 0; round < 10; ++round) {
        std::vector<double> terms(1 + draw.below(100));
        for (double& term : terms) term = draw.near(centre, spread);
        expect_exact(terms, draw);
      }
}

// What is left when all that is large has gone, and nothing when everything has.
TEST(ExactSum, CancellationLeavesWhatIsLeft) {
  Draw draw;
  for (int round = 0; round < 300; ++round) {
    std::vector<double> terms;
    for (std::size_t i = draw.below(50) + 1; i-- > 0;) {
      terms.push_back(draw.any());
      terms.push_back(-terms.back());
    }
    draw.shuffle(terms);
    EXPECT_THAT(summed(terms), same_bits(0.0));
    const double left = draw.any();
    terms.push_back(left);
    draw.shuffle(terms);
    EXPECT_THAT(summed(terms), same_bits(left));
  }
}

TEST(ExactSum, OneTermIsItself) {
  for (const double term :
       {1.0, -1.0, std::numbers::pi, 5e-324, -5e-324, Limits::min(), -Limits::min(),
        Limits::min() - 5e-324, 0x1p-1021, Limits::max(), Limits::lowest()})
    EXPECT_THAT(summed({term}), same_bits(term));
  EXPECT_THAT(summed({}), same_bits(0.0));
  EXPECT_THAT(summed({-0.0, 0.0}), same_bits(0.0));
}

TEST(ExactSum, TiesGoToEven) {
  const double half = 0x1p-53, little = 0x1p-1074;  // half of the last bit of 1
  EXPECT_THAT(summed({1, half}), same_bits(1));
  EXPECT_THAT(summed({1, half, little}), same_bits(1 + 0x1p-52));
  EXPECT_THAT(summed({1, half, -little}), same_bits(1));
  EXPECT_THAT(summed({1 + 0x1p-52, half}), same_bits(1 + 0x1p-51));
  EXPECT_THAT(summed({1 + 0x1p-52, half, -little}), same_bits(1 + 0x1p-52));
  EXPECT_THAT(summed({-1, -half, -little}), same_bits(-1 - 0x1p-52));
  EXPECT_THAT(summed({-1 - 0x1p-52, -half}), same_bits(-1 - 0x1p-51));
}

TEST(ExactSum, BeyondTheRange) {
  const double max = Limits::max(),
               half = 0x1p970;  // half of its last bit: from there on it rounds up
  EXPECT_THAT(summed({max, max}), same_bits(Limits::infinity()));
  EXPECT_THAT(summed({-max, -max}), same_bits(-Limits::infinity()));
  EXPECT_THAT(summed({max, half}), same_bits(Limits::infinity()));
  EXPECT_THAT(summed({max, half, -5e-324}), same_bits(max));
  EXPECT_THAT(summed({-max, -half, 5e-324}), same_bits(-max));
  EXPECT_THAT(summed({max, max, max, -max, 7, -max, -max}), same_bits(7));  // it was, on the way
  std::vector<double> many(100'000, max);
  many.resize(200'000, -max);
  many.push_back(-5e-324);
  EXPECT_THAT(summed(many), same_bits(-5e-324));
}

TEST(ExactSum, InfinityAndNan) {
  const double infinity = Limits::infinity(), nan = Limits::quiet_NaN();
  for (const bool by_numbers : {false, true}) {
    const auto of = [&](const std::vector<double>& terms) {
      return summed_in_parts(terms, 3, by_numbers);
    };
    EXPECT_THAT(of({1, infinity, -Limits::max(), infinity}), same_bits(infinity));
    EXPECT_THAT(of({1, -infinity, Limits::max()}), same_bits(-infinity));
    EXPECT_TRUE(std::isnan(of({1, infinity, 2, -infinity})));
    EXPECT_TRUE(std::isnan(of({1, nan, 2, 3})));
    EXPECT_TRUE(std::isnan(of({-nan, infinity})));
  }
}

// Threads of a run take the smallest doubles for zero in their own arithmetic: not here.
TEST(ExactSum, FlushingToZeroChangesNothing) {
  const FloatingMode before = floating_mode();
  set_floating_mode(before | denormals_to_zero);
  const double one = summed({5e-324}), some = summed({3e-310, -Limits::min(), 5e-324}),
               normal = summed({Limits::min(), 5e-324}), large = summed({1, 5e-324, 0x1p-53});
  set_floating_mode(before);
  EXPECT_THAT(one, same_bits(5e-324));
  EXPECT_THAT(some, same_bits(reference({3e-310, -Limits::min(), 5e-324})));
  EXPECT_THAT(normal, same_bits(Limits::min() + 5e-324));
  EXPECT_THAT(large, same_bits(1 + 0x1p-52));
}

// 2^40 terms, of which nearly all cancel.
TEST(ExactSum, SumsOfSums) {
  ExactSum sum;
  sum.add(Limits::max());
  sum.add(-0x1p-1000);
  for (int i = 0; i < 40; ++i) sum.add(ExactSum(sum));
  EXPECT_THAT(sum.value(), same_bits(Limits::infinity()));
  for (int i = 0; i < 39; ++i) {
    ExactSum part;
    part.add(-Limits::max());
    for (int k = 0; k < i; ++k) part.add(ExactSum(part));
    sum.add(part);
  }
  sum.add(-Limits::max());  // 2^39 are left
  ExactSum rest;
  rest.add(-Limits::max());
  for (int k = 0; k < 39; ++k) rest.add(ExactSum(rest));
  sum.add(rest);
  EXPECT_THAT(sum.value(), same_bits(-0x1p-960));
}

}  // namespace
}  // namespace pulvis
