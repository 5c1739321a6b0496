// Contact kernels: B-spline curve, closest point, normal spring, Coulomb friction.
#include "systems/contact/contact_kernel.hpp"
#include "systems/laws/friction.hpp"
#include "systems/laws/normal_contact.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/helpers/random_values.hpp"

namespace pulvis::kernels {
namespace {

constexpr double round_off = 4e-16;  // a few units of the last place of numbers near one

double dot(const std::array<double, 4>& n, const double* y) {
  return n[0] * y[0] + n[1] * y[1] + n[2] * y[2] + n[3] * y[3];
}

TEST(CurveBasis, SumsToOneAndIsNowhereNegative) {
  const double ones[4] = {1, 1, 1, 1};
  for (double u = 0; u <= 1; u += 1.0 / 64) {
    EXPECT_NEAR(dot(basis(u), ones), 1, round_off);
    EXPECT_NEAR(dot(basis_slope(u), ones), 0, round_off);
    for (const double n : basis(u)) EXPECT_GE(n, 0);
  }
}

TEST(CurveBasis, ReproducesAStraightLine) {
  const double line[4] = {-1, 0, 1, 2};
  for (double u = 0; u <= 1; u += 1.0 / 64) {
    EXPECT_NEAR(dot(basis(u), line), u, round_off);
    EXPECT_NEAR(dot(basis_slope(u), line), 1, 2 * round_off);
  }
}

TEST(CurveBasis, SlopeIsTheDerivative) {
  const double h =
      1e-4;  // a cubic: the error of central differences is h^2/6 times its third derivative
  for (double u = 0; u <= 1; u += 1.0 / 64)
    for (std::size_t a = 0; a < 4; ++a)
      EXPECT_NEAR((basis(u + h)[a] - basis(u - h)[a]) / (2 * h), basis_slope(u)[a], 1e-8) << a;
}

TEST(CurveBasis, JoinsWithContinuousCurvature) {
  Random random(1);
  double y[5];
  for (double& v : y) v = random.in(-1, 1);
  const auto left = cubic(y[0], y[1], y[2], y[3]), right = cubic(y[1], y[2], y[3], y[4]);
  EXPECT_NEAR(left.value(1), right.value(0), 2 * round_off);
  EXPECT_NEAR(left.slope(1), right.slope(0), 4 * round_off);
  EXPECT_NEAR(left.curvature(1), right.curvature(0), 8 * round_off);
}

TEST(CurveBasis, CubicIsTheSumOfTheBasis) {
  Random random(2);
  for (int i = 0; i < 1000; ++i) {
    double y[4];
    for (double& v : y) v = random.in(-1, 1);
    const double u = random.in(0, 1);
    const auto curve = cubic(y[0], y[1], y[2], y[3]);
    ASSERT_NEAR(curve.value(u), dot(basis(u), y), 4 * round_off);
    ASSERT_NEAR(curve.slope(u), dot(basis_slope(u), y), 10 * round_off);
    const double second = (1 - u) * y[0] + (3 * u - 2) * y[1] + (1 - 3 * u) * y[2] + u * y[3];
    ASSERT_NEAR(curve.curvature(u), second, 20 * round_off);
  }
}

TEST(EdgePoints, IntegrateEveryPolynomialOfDegreeSeven) {
  for (int power = 0; power <= 7; ++power) {
    double integral = 0;
    for (int g = 0; g < 4; ++g) integral += edge_w[g] * std::pow(edge_u[g], power);
    EXPECT_NEAR(integral, 1.0 / (power + 1), round_off) << power;
  }
}

// Where the search from angle `start` ends for a point at (distance, 0) off a unit circle.
double closest_angle(double distance, double start, int steps) {
  double u = start;
  for (int i = 0; i < steps; ++i) {
    const double c = std::cos(u), s = std::sin(u);
    u += closest_point_step(distance - c, -s, -s, c, -c, -s);
  }
  return u;
}

TEST(ClosestPoint, ConvergesOnACircleFromBothSides) {
  // phi <- phi - tan phi, of third order: 0.5, -0.05, 3e-5, 1e-14.
  for (const double distance : {0.7, 0.9, 1.1, 2.0})
    for (const double start : {-0.5, -0.1, 0.02, 0.5})
      EXPECT_NEAR(closest_angle(distance, start, 5), 0, 1e-14) << distance << " " << start;
}

TEST(ClosestPoint, StaysAtTheClosestPoint) {
  EXPECT_EQ(closest_angle(1.1, 0, 1), 0);
  EXPECT_EQ(closest_angle(0.9, 0, 1), 0);
}

TEST(ClosestPoint, StepsDownhillAlsoOnTheFarSide) {
  for (double start = 0.1; start < std::numbers::pi; start += 0.1) {
    EXPECT_LT(closest_angle(1.1, start, 1), start);
    EXPECT_GT(closest_angle(1.1, -start, 1), -start);
  }
}

TEST(ClosestPoint, IsPerpendicularToASpline) {
  const auto x = cubic(-1.2, 0.1, 1.0, 2.1), y = cubic(0.3, 0.0, 0.1, 0.5);
  const double px = 0.5, py = 0.3;
  double u = 0.2;
  for (int i = 0; i < 6; ++i)
    u += closest_point_step(px - x.value(u), py - y.value(u), x.slope(u), y.slope(u),
                            x.curvature(u), y.curvature(u));
  EXPECT_NEAR((px - x.value(u)) * x.slope(u) + (py - y.value(u)) * y.slope(u), 0, 4 * round_off);
}

constexpr double edge = 1e-4;  // m, so that springs bear twice at 5e-6

TEST(NormalTraction, PressureIsTheDerivativeOfTheEnergy) {
  const double kappa = 3e15, h = 1e-9;
  for (const double g : {-1e-6, 1e-7, 2e-6}) {
    const auto energy = [&](double gap) {
      return normal_traction(gap, 0.0, kappa, 0.0, 1 / edge).spring_energy;
    };
    // The third derivative of the energy leaves kappa h^2/g_s^2; energies round at 1e-16 of theirs, over h.
    EXPECT_NEAR((energy(g + h) - energy(g - h)) / (2 * h),
                normal_traction(g, 0.0, kappa, 0.0, 1 / edge).pressure, 1e-7 * kappa * 2e-6);
  }
}

TEST(NormalTraction, StiffensAsItsTangentSays) {
  const double kappa = 3e15, h = 1e-10;
  for (const double g : {1e-7, 5e-6, 2e-5}) {
    const double slope = (normal_traction(g + h, 0.0, kappa, 0.0, 1 / edge).pressure -
                          normal_traction(g - h, 0.0, kappa, 0.0, 1 / edge).pressure) /
                         (2 * h);
    EXPECT_NEAR(slope / kappa / stiffening(g / edge), 1, 1e-6);
  }
  EXPECT_DOUBLE_EQ(normal_traction(5e-6, 0.0, kappa, 0.0, 1 / edge).pressure, 2 * kappa * 5e-6);
}

TEST(NormalTraction, NeverPullsAndItsDampingNeverGives) {
  Random random(3);
  for (int i = 0; i < 10000; ++i) {
    const auto t =
        normal_traction(random.in(-1e-6, 1e-6), random.in(-10.0, 10.0), 3e15, 1e9, 1 / edge);
    ASSERT_GE(t.pressure, 0);
    ASSERT_GE(t.damping_power, 0);
    ASSERT_GE(t.spring_energy, 0);
  }
}

TEST(NormalTraction, IsNothingWhereNothingTouches) {
  for (const double rate : {-10.0, 0.0, 10.0}) {
    const auto t = normal_traction(-1e-9, rate, 3e15, 1e9, 1 / edge);
    EXPECT_EQ(t.pressure, 0);
    EXPECT_EQ(t.spring_energy, 0);
    EXPECT_EQ(t.damping_power, 0);
  }
}

TEST(NormalTraction, DampingAddsItsShareOfTheRate) {
  const auto t = normal_traction(1e-6, 2.0, 3e15, 1e8, 1 / edge);
  EXPECT_DOUBLE_EQ(t.pressure, 3e9 * (1 + 0.2 * 0.2) + 2e8);
  // The difference of spring and whole carries the round-off of the whole: 16 times its own.
  EXPECT_NEAR(t.damping_power, 2 * 2e8, 1e-14 * 3.2e9);
}

template <class T>
Friction<T> coulomb_return(T elastic_slip, T slip, T pressure, T mu, T kappa, T inv_kappa) {
  Coulomb<T> law{mu};
  return friction_return(elastic_slip, slip, pressure, law, kappa, inv_kappa);
}

// What the mean traction does is stored or spent, whatever the pressure does meanwhile; nothing is given back while
// that does not fall.
TEST(CoulombReturn, TractionStaysInTheConeAndItsWorkIsBookedWhole) {
  Random random(4);
  const double mu = 0.3, kappa = 3e15;
  double stretch = 0, spent = 0, before = 0;
  int given = 0;
  for (int i = 0; i < 10000; ++i) {
    const double pressure = std::max(random.in(-1e8, 1e9), 0.0), slip = random.in(-2e-7, 2e-7);
    const auto f = coulomb_return(stretch, slip, pressure, mu, kappa, 1 / kappa);
    ASSERT_LE(std::abs(f.traction), mu * pressure * (1 + round_off));
    const double stored = 0.5 * kappa * (f.elastic_slip * f.elastic_slip - stretch * stretch);
    const double done = 0.5 * kappa * (stretch + f.elastic_slip) * slip;
    ASSERT_NEAR(stored + f.work, done, 1e-14 * kappa * 4e-14);  // of the largest slip's square
    if (pressure >= before) {
      ASSERT_GE(f.work, 0);
    }
    if (f.work < 0) ++given;
    stretch = f.elastic_slip, before = pressure;
    spent += f.work;
  }
  EXPECT_GT(spent, 0);
  EXPECT_GT(given, 0);
}

TEST(CoulombReturn, BooksWhatAReversalUnderFallingPressureGives) {
  const double mu = 0.3, kappa = 3e15, p = 1e9, limit = mu * p / kappa;
  // From one limit over the other, which has fallen to a half: mean stretch limit/4 on the way, 3/2 limit back.
  const auto f = coulomb_return(limit, -3 * limit, 0.5 * p, mu, kappa, 1 / kappa);
  EXPECT_DOUBLE_EQ(f.elastic_slip, -0.5 * limit);
  EXPECT_DOUBLE_EQ(f.work, -0.375 * kappa * limit * limit);
}

TEST(CoulombReturn, PullsAgainstTheSlip) {
  EXPECT_DOUBLE_EQ(coulomb_return(0.0, 1e-8, 1e9, 0.3, 3e15, 1 / 3e15).traction, -3e7);
  EXPECT_DOUBLE_EQ(coulomb_return(0.0, -1e-8, 1e9, 0.3, 3e15, 1 / 3e15).traction, 3e7);
  EXPECT_DOUBLE_EQ(coulomb_return(0.0, 1.0, 1e9, 0.3, 3e15, 1 / 3e15).traction, -3e8);
}

TEST(CoulombReturn, GivesAllEnergyBackBelowTheLimit) {
  const double kappa = 3e15, limit = 0.3 * 1e9 / kappa;
  const auto there = coulomb_return(0.0, 0.9 * limit, 1e9, 0.3, kappa, 1 / kappa);
  const auto back = coulomb_return(there.elastic_slip, -0.9 * limit, 1e9, 0.3, kappa, 1 / kappa);
  EXPECT_EQ(there.work, 0);
  EXPECT_EQ(back.work, 0);
  EXPECT_EQ(back.elastic_slip, 0);
  EXPECT_EQ(back.traction, 0);
}

TEST(CoulombReturn, SpendsLimitTimesSlipAroundALoop) {
  const double mu = 0.3, p = 1e9, kappa = 3e15, limit = mu * p / kappa, reach = 10 * limit;
  const int steps = 4000;
  double slip = 0, spent = 0, at = 0;
  for (int i = 1; i <= steps; ++i) {
    const double next = reach * std::sin(2 * std::numbers::pi * i / steps);
    const auto f = coulomb_return(slip, next - at, p, mu, kappa, 1 / kappa);
    at = next;
    slip = f.elastic_slip;
    spent += f.work;
  }
  // 4 reach of travel; the spring takes `limit` once and 2 limit at each of the two turns.
  // The work of a step is that of its mean traction: exact while it slides, off by at most half a step's
  // slip times the limit in each of the five steps in which it begins to.
  const double step = reach * 2 * std::numbers::pi / steps;
  EXPECT_NEAR(spent, mu * p * (4 * reach - 5 * limit), 2.5 * mu * p * step);
}

TEST(CoulombReturn, LosingThePressureLosesTheSpring) {
  const auto f = coulomb_return(5e-8, 0.0, 0.0, 0.3, 3e15, 1 / 3e15);
  EXPECT_EQ(f.traction, 0);
  EXPECT_EQ(f.elastic_slip, 0);
}

// mu(s) = mu_d + (mu_s - mu_d) e^(-s/L) under steady sliding, of first order in the step.
TEST(WeakeningFriction, FallsFromStaticToDynamicAsAnExponential) {
  const double kappa = 3e15, p = 1e8, length = 1e-4, infinite = 1e300;
  double worst[2] = {0, 0};
  for (int fine = 0; fine < 2; ++fine) {
    Weakening<double> law{0.2, 0.3, 1 / length, infinite, 0, 0};
    const double step = fine == 0 ? 1e-6 : 1e-7;
    double slip = 0, way = 0;
    for (int i = 0; i < (fine == 0 ? 400 : 4000); ++i) {
      const double slid = way - slip;  // what the spring does not keep
      const auto f = friction_return(slip, step, p, law, kappa, 1 / kappa);
      slip = f.elastic_slip;
      const double exact = 0.2 + 0.3 * std::exp(-slid / length);
      worst[fine] = std::max(worst[fine], std::abs(-f.traction / p - exact));
      way += step;
    }
  }
  EXPECT_LT(worst[1], 2e-4);
  EXPECT_NEAR(worst[0] / worst[1], 10, 1.5);
}

TEST(WeakeningFriction, HoldsWhatIsBelowTheStaticStrength) {
  const double kappa = 3e15, p = 1e8;
  Weakening<double> law{0.2, 0.3, 1e4, 1e300, 0, 0};
  const auto f = friction_return(0.0, 0.45 * p / kappa, p, law, kappa, 1 / kappa);
  EXPECT_DOUBLE_EQ(f.traction, -0.45 * p);
  EXPECT_EQ(law.lost, 0);
  EXPECT_EQ(f.work, 0);
}

TEST(WeakeningFriction, NeverPassesTheShearStrength) {
  const double kappa = 3e15;
  Weakening<double> law{0.3, 0, 0, 5e7, 0, 0};
  for (const double p : {1e8, 1e9, 1e10}) {
    const auto f = friction_return(0.0, 1.0, p, law, kappa, 1 / kappa);
    EXPECT_DOUBLE_EQ(f.traction, -std::min(0.3 * p, 5e7));
  }
}

TEST(RateFriction, AddsALogarithmAndNeverFallsBelowNothing) {
  const double kappa = 3e15, p = 1e8;
  EXPECT_EQ(rate_effect(0.0, -0.1, 100.0), 0);
  EXPECT_NEAR(rate_effect(0.99, 0.02, 100.0), 0.02 * std::log(100.0), 1e-15);
  for (const double by_speed : {0.05, -0.05, -0.5}) {
    Weakening<double> law{0.3, 0, 0, 1e300, 0, by_speed};
    const auto f = friction_return(0.0, 1.0, p, law, kappa, 1 / kappa);
    EXPECT_DOUBLE_EQ(f.traction, -std::max(0.0, 0.3 + by_speed) * p);
    EXPECT_GE(f.work, 0);
  }
}

TEST(ContactKernels, LanesGiveTheBitsOfTheScalar) {
  Random random(5);
  for (int i = 0; i < 1000; ++i) {
    const Lane g = random.lane(-1e-6, 1e-6), rate = random.lane(-1, 1),
               u = random.lane(-1e-7, 1e-7);
    const auto normal = normal_traction<Lane>(g, rate, 3e15, 1e9, 1 / edge);
    const auto friction =
        coulomb_return<Lane>(u, rate * 1e-7, normal.pressure, 0.3, 3e15, 1 / 3e15);
    for (int l = 0; l < lane_count; ++l) {
      const auto n = normal_traction(g[l], rate[l], 3e15, 1e9, 1 / edge);
      const auto f = coulomb_return(u[l], rate[l] * 1e-7, n.pressure, 0.3, 3e15, 1 / 3e15);
      // Every bit but the sign of a zero, which a lane's max may take from its other operand.
      ASSERT_EQ(normal.pressure[l], n.pressure);
      ASSERT_EQ(normal.damping_power[l], n.damping_power);
      ASSERT_EQ(friction.elastic_slip[l], f.elastic_slip);
      ASSERT_EQ(friction.work[l], f.work);
    }
  }
}

}  // namespace
}  // namespace pulvis::kernels
