// Four lanes do what four doubles do: every function of a lane gives the bits of the scalar one.
#include "engine/lane.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/kernels/random_values.hpp"

namespace pulvis {
namespace {

using kernels::bits;

constexpr double infinity = std::numeric_limits<double>::infinity();
// Signs, an integer, the ends of the range and a value that is no binary fraction.
const Lane mixed{-2.5, 0.1, infinity, 1e-300};
const Lane other{3.0, 0.1, -infinity, 7e-301};

template <class OfLanes, class OfDoubles>
void expect_same_bits(const OfLanes& lanes, const OfDoubles& doubles) {
  kernels::Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const Lane a = random.lane(-10, 10), b = random.lane(-10, 10), c = random.lane(-10, 10);
    const Lane result = lanes(a, b, c);
    for (int l = 0; l < lane_count; ++l)
      ASSERT_EQ(bits(result[l]), bits(doubles(a[l], b[l], c[l]))) << a[l] << " " << b[l];
  }
}

TEST(Lane, BroadcastPutsTheValueInEveryLane) {
  const Lane all = broadcast(0.1);
  for (int l = 0; l < lane_count; ++l) EXPECT_EQ(all[l], 0.1);
}

TEST(Lane, SelectTakesEachLaneByItsOwnMask) {
  const Lane chosen = select(mixed < other, mixed, other);
  for (int l = 0; l < lane_count; ++l)
    EXPECT_EQ(chosen[l], select(mixed[l] < other[l], mixed[l], other[l])) << l;
}

TEST(Lane, AnyAndAllCountTheLanes) {
  const auto masked = [](bool a, bool b, bool c, bool d) {
    return Lane{double(a), double(b), double(c), double(d)} > 0.5;
  };
  for (int m = 0; m < 16; ++m) {
    const LaneMask mask = masked(m & 1, m & 2, m & 4, m & 8);
    EXPECT_EQ(any(mask), m != 0) << m;
    EXPECT_EQ(all(mask), m == 15) << m;
  }
}

TEST(Lane, LeastAndGreatestOfTwoAreTheScalarOnes) {
  for (int l = 0; l < lane_count; ++l) {
    EXPECT_EQ(min(mixed, other)[l], min(mixed[l], other[l])) << l;
    EXPECT_EQ(max(mixed, other)[l], max(mixed[l], other[l])) << l;
  }
  expect_same_bits([](Lane a, Lane b, Lane) { return min(a, b); },
                   [](double a, double b, double) { return min(a, b); });
  expect_same_bits([](Lane a, Lane b, Lane) { return max(a, b); },
                   [](double a, double b, double) { return max(a, b); });
}

TEST(Lane, AbsAndRootAreTheScalarOnes) {
  expect_same_bits([](Lane a, Lane, Lane) { return abs(a); },
                   [](double a, double, double) { return abs(a); });
  expect_same_bits([](Lane a, Lane, Lane) { return sqrt(abs(a)); },
                   [](double a, double, double) { return std::sqrt(std::abs(a)); });
}

TEST(Lane, FusedMultiplyAddIsRoundedOnce) {
  expect_same_bits([](Lane a, Lane b, Lane c) { return fma(a, b, c); },
                   [](double a, double b, double c) { return std::fma(a, b, c); });
  // (1 + e)(1 - e) - 1 = -e^2: lost wholly when the product is rounded by itself.
  constexpr double e = 0x1p-30;
  EXPECT_EQ(fma(broadcast(1 + e), 1 - e, -1.0)[2], -e * e);
  EXPECT_EQ(fma(1 + e, 1 - e, -1.0), -e * e);
}

TEST(Lane, FusedMultiplyAddTakesScalarsInEveryPlace) {
  expect_same_bits([](Lane a, Lane, Lane c) { return fma(a, 0.3, c); },
                   [](double a, double, double c) { return std::fma(a, 0.3, c); });
  expect_same_bits([](Lane, Lane b, Lane) { return fma(0.3, b, 0.7); },
                   [](double, double b, double) { return std::fma(0.3, b, 0.7); });
}

TEST(Lane, SumIsPairwiseInFixedOrder) {
  // Beside 1e16 a one is lost: in pairs both are, one after the other one is, crosswise none.
  EXPECT_EQ(sum(Lane{1e16, 1, -1e16, 1}), 0);
  EXPECT_EQ(sum(Lane{1e16, -1e16, 1, 1}), 2);
  EXPECT_EQ(sum(Lane{1, 2, 4, 8}), 15);
}

TEST(Lane, LeastAndGreatestLookAtAllLanes) {
  for (int l = 0; l < lane_count; ++l) {
    Lane a = broadcast(1.0);
    a[l] = -5;
    EXPECT_EQ(least(a), -5) << l;
    EXPECT_EQ(greatest(-a), 5) << l;
    EXPECT_EQ(greatest(a), 1) << l;
  }
}

}  // namespace
}  // namespace pulvis
