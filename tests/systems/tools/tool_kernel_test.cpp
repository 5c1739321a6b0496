// Prescribed motion of a tool: from 0 to 1, smooth, the same forwards as backwards.
#include "systems/tools/tool_kernel.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace pulvis::kernels {
namespace {

const std::vector<double> ramps{0.0, 0.01, 0.1, 0.25, 0.5};

TEST(SmoothTravel, GoesFromZeroToOneAndStaysThere) {
  for (const double ramp : ramps) {
    EXPECT_EQ(smooth_travel(-0.5, ramp), 0);
    EXPECT_EQ(smooth_travel(0, ramp), 0);
    EXPECT_EQ(smooth_travel(1, ramp), 1);
    EXPECT_EQ(smooth_travel(1.5, ramp), 1);
    EXPECT_NEAR(smooth_travel(1 - 1e-12, ramp), 1, 2.1e-12);  // top speed is at most 2
  }
}

TEST(SmoothTravel, NeverTurnsBack) {
  for (const double ramp : ramps)
    for (int i = 0; i < 10000; ++i)
      ASSERT_GE(smooth_travel((i + 1) * 1e-4, ramp), smooth_travel(i * 1e-4, ramp))
          << ramp << " " << i;
}

TEST(SmoothTravel, IsSymmetricInTime) {
  for (const double ramp : ramps)
    for (int i = 0; i <= 1000; ++i)  // values up to 1: a few units of the last place
      ASSERT_NEAR(smooth_travel(i * 1e-3, ramp) + smooth_travel(1 - i * 1e-3, ramp), 1, 1e-15);
}

TEST(SmoothTravel, IsStraightBetweenTheRamps) {
  for (const double ramp : ramps)
    for (double tau = ramp; tau <= 1 - ramp; tau += 0.01)
      ASSERT_NEAR(smooth_travel(tau, ramp), (tau - ramp / 2) / (1 - ramp), 1e-15) << ramp;
}

// The speed of the k-th interval of length h, by differences.
double speed(int k, double h, double ramp) {
  return (smooth_travel((k + 1) * h, ramp) - smooth_travel(k * h, ramp)) / h;
}

TEST(SmoothTravel, SpeedHasNoJump) {
  const double h = 1e-3;
  for (const double ramp : {0.1, 0.25, 0.5}) {
    // Steepest rise of u^3 (10 - 15 u + 6 u^2): 15/8, at u = 1/2.
    const double steepest = 1.875 / ramp / (1 - ramp);
    for (int k = -2; k < 1002; ++k)
      ASSERT_LE(std::abs(speed(k + 1, h, ramp) - speed(k, h, ramp)), steepest * h * (1 + 1e-9))
          << k;
  }
}

TEST(SmoothTravel, AccelerationHasNoJump) {
  const double h = 1e-3;
  for (const double ramp : {0.1, 0.25, 0.5}) {
    // Steepest change of 30 u^2 (1 - u)^2: 10/sqrt 3. Round-off of a second difference: 1e-16/h^2.
    const double steepest = 10 / std::sqrt(3.0) / (ramp * ramp * (1 - ramp));
    const auto acceleration = [&](int k) {
      return (speed(k + 1, h, ramp) - speed(k, h, ramp)) / h;
    };
    for (int k = -3; k < 1002; ++k)
      ASSERT_LE(std::abs(acceleration(k + 1) - acceleration(k)), steepest * h + 2e-9) << k;
  }
}

TEST(SmoothTravel, AccelerationStartsWithoutAKink) {
  // 30 u^2 (1 - u)^2: a hundredth of the way up the ramp not more than 0.3% of top speed a ramp.
  const double ramp = 0.2, h = 1e-4, u = 0.01;
  const int k = static_cast<int>(u * ramp / h);
  const double acceleration = (speed(k + 1, h, ramp) - speed(k, h, ramp)) / h;
  EXPECT_LT(acceleration * ramp * (1 - ramp),
            1.2 * 30 * u * u);  // differences look half a step ahead
}

TEST(CutTravel, IsTheWholeWayWhereNothingIsCut) {
  for (const double tau : {-0.1, 0.03, 0.5, 0.97, 1.2})
    EXPECT_EQ(cut_travel(tau, 0.1, 1e300), smooth_travel(tau, 0.1));
}

// Whenever it is cut; from where the speed falls anyway, the whole way.
TEST(TravelToRest, IsWhatCutTravelGoesOn) {
  for (const double ramp : {0.0, 0.1, 0.5})
    for (const double tau : {-0.1, 0.0, 0.03, 0.3, 0.49, 0.5, 0.6, 0.95, 1.0, 1.2}) {
      const double end = tau < 1 - ramp ? cut_travel(tau + 2, ramp, tau) : 1;
      EXPECT_NEAR(smooth_travel(tau, ramp) + travel_to_rest(tau, ramp), end, 1e-14) << tau << ramp;
    }
}

TEST(CutTravel, ComesToRestSmoothlyHalfARampOfItsSpeedFurther) {
  const double ramp = 0.2, step = 1e-5;
  for (const double cut : {0.05, 0.2, 0.6}) {
    const double speed = smooth_speed(cut, ramp);
    EXPECT_NEAR(speed,
                (smooth_travel(cut + step, ramp) - smooth_travel(cut - step, ramp)) / (2 * step),
                1e-6);
    EXPECT_NEAR(cut_travel(cut + step, ramp, cut) - cut_travel(cut, ramp, cut), speed * step, 1e-9);
    const double end = smooth_travel(cut, ramp) + 0.5 * speed * ramp;
    EXPECT_NEAR(cut_travel(cut + ramp, ramp, cut), end, 1e-14);
    EXPECT_NEAR(cut_travel(cut + ramp - step, ramp, cut), end, 1e-9);
    EXPECT_EQ(cut_travel(cut + 10, ramp, cut), cut_travel(cut + ramp, ramp, cut));
  }
}

}  // namespace
}  // namespace pulvis::kernels
