// Yield points of a solid that is known: linear elastic, perfectly plastic along the normal of a circle in the plane of the
// stresses xx and yy.
#include "cli/campaigns/probe/yield_points.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace pulvis {
namespace {

constexpr double c11 = 10e9, c12 = 3e9, c22 = 8e9, g = 2e9, yield = 20e6;
using std::numbers::pi;

// Radial return in the stress plane: not associated where the moduli differ, but its yield point is on the circle.
ProbeCurve probed(double angle) {
  ProbeCurve curve;
  curve.angle = angle;
  double xx = 0, yy = 0, spent = 0;
  constexpr int steps = 4000;
  const double dx = 0.02 / steps * std::cos(angle), dy = 0.02 / steps * std::sin(angle);
  for (int i = 0; i <= steps; ++i) {
    curve.strain.push_back({i * dx, i * dy, 0});
    curve.stress.push_back({xx, yy, 0, 0.3 * (xx + yy)});
    curve.dissipated.push_back(spent);
    const double tx = xx + c11 * dx + c12 * dy, ty = yy + c12 * dx + c22 * dy;
    const double size = std::hypot(tx, ty), share = std::min(1.0, yield / size);
    const double det = c11 * c22 - c12 * c12, over = 1 - share;
    spent += over * (tx * (c22 * tx - c12 * ty) + ty * (c11 * ty - c12 * tx)) / det * share;
    xx = share * tx, yy = share * ty;
  }
  return curve;
}

std::vector<ProbeCurve> all_probed() {
  std::vector<ProbeCurve> curves;
  for (int k = 0; k < 24; ++k) curves.push_back(probed(2 * pi * k / 24));
  return curves;
}

TEST(PowderModuli, AreThoseOfTheElasticParts) {
  ProbeCurve shear;
  for (int i = 0; i < 100; ++i) {
    shear.strain.push_back({0, 0, i * 1e-5});
    shear.stress.push_back({0, 0, 2 * g * i * 1e-5, 0});
  }
  const PowderModuli m = moduli_of(all_probed(), &shear, 2e-4);
  EXPECT_NEAR(m.c11 / c11, 1, 1e-9);
  EXPECT_NEAR(m.c12 / c12, 1, 1e-9);
  EXPECT_NEAR(m.c22 / c22, 1, 1e-9);
  EXPECT_NEAR(m.g / g, 1, 1e-9);
}

TEST(PowderModuli, GiveBackAnIsotropicSolid) {
  const double e = 70e9, nu = 0.3, lambda = e * nu / ((1 + nu) * (1 - 2 * nu)),
               mu = e / (2 + 2 * nu);
  const PowderModuli m{lambda + 2 * mu, lambda, lambda + 2 * mu, mu};
  EXPECT_NEAR(m.youngs_modulus() / e, 1, 1e-12);
  EXPECT_NEAR(m.poissons_ratio(), nu, 1e-12);
}

TEST(PowderModuli, OfAnElasticSolidTakeEnergyForEveryStrain) {
  EXPECT_TRUE((PowderModuli{c11, c12, c22, g}.are_of_a_solid()));
  EXPECT_FALSE((PowderModuli{c11, 1.01 * std::sqrt(c11 * c22), c22, g}.are_of_a_solid()));
  EXPECT_FALSE((PowderModuli{-c11, 0, -c22, g}.are_of_a_solid()));
  EXPECT_FALSE((PowderModuli{c11, c12, c22, -g}.are_of_a_solid()));
}

TEST(YieldPoints, AreOnTheSurfaceAndFlowAlongItsNormal) {
  const std::vector<ProbeCurve> curves = all_probed();
  const PowderModuli m = moduli_of(curves, nullptr, 2e-4);
  std::vector<YieldPoint> points;
  for (const ProbeCurve& curve : curves) {
    const auto by_offset = offset_yield(curve, m, 0.002);
    const auto by_energy = dissipation_yield(curve, m, 0.002 * yield);
    ASSERT_TRUE(by_offset && by_energy) << curve.angle;
    for (const auto& point : {*by_offset, *by_energy})
      EXPECT_NEAR(std::hypot(point.stress[0], point.stress[1]) / yield, 1, 1e-3) << curve.angle;
    points.push_back(*by_offset);
  }
  find_normality(points, {0, 0}, 24);
  for (const YieldPoint& point : points) {
    // C^-1 sigma is not along sigma: the angle between them is the law's.
    const double px = c22 * point.stress[0] - c12 * point.stress[1];
    const double py = c11 * point.stress[1] - c12 * point.stress[0];
    const double law =
        std::acos((px * point.stress[0] + py * point.stress[1]) / (std::hypot(px, py) * yield));
    ASSERT_TRUE(point.normality);
    EXPECT_NEAR(*point.normality, law, 0.15);
  }
}

// The two sides of a wedge, of which only the outer ends yield: each has its own normal, and no line joins the ends.
TEST(YieldPoints, AtTheEndsOfAnOpenSurfaceHaveNoNormal) {
  std::vector<YieldPoint> points;
  for (const int k : {7, 8, 9, 15, 16, 17}) {  // of 24: 105 to 135 degrees, 225 to 255 degrees
    YieldPoint point;
    point.angle = 2 * pi * k / 24;
    const double side = k < 12 ? 1 : -1, along = std::abs(k - 12);
    point.stress = {-along, side * along, 0, 0};
    point.plastic = {std::sqrt(0.5), side * std::sqrt(0.5)};
    points.push_back(point);
  }
  find_normality(points, {-8, 0}, 24);
  for (const YieldPoint& point : points) {
    const double k = std::round(point.angle * 24 / (2 * pi));
    EXPECT_EQ(point.normality.has_value(), k == 8 || k == 16) << k;
    EXPECT_NEAR(point.normality.value_or(0), 0, 1e-7) << k;
  }
}

// Where two points share nearly one stress, such as at a vertex, their order may be reversed: that is no gap.
TEST(YieldPoints, ThatFollowInAnotherOrderAreNoGap) {
  std::vector<YieldPoint> points;
  for (int k = 0; k < 12; ++k) {
    if (k == 6) continue;  // the surface is open there
    YieldPoint point;
    point.angle = 2 * pi * k / 12;
    const double turned = k == 2 ? 3.0 : k == 3 ? 2.0 : k;
    point.stress = {std::cos(2 * pi * turned / 12), std::sin(2 * pi * turned / 12), 0, 0};
    point.plastic = {point.stress[0], point.stress[1]};
    points.push_back(point);
  }
  find_normality(points, {0, 0}, 12);
  for (const YieldPoint& point : points) {
    const double k = std::round(point.angle * 12 / (2 * pi));
    EXPECT_EQ(point.normality.has_value(), k != 5 && k != 7) << k;
    EXPECT_NEAR(point.normality.value_or(0), 0, 1e-7) << k;
  }
}

TEST(YieldPoints, AreMissingWhereNothingYields) {
  ProbeCurve curve;
  for (int i = 0; i < 10; ++i) {
    curve.strain.push_back({i * 1e-4, 0, 0});
    curve.stress.push_back({c11 * i * 1e-4, c12 * i * 1e-4, 0, 0});
    curve.dissipated.push_back(0);
  }
  const PowderModuli m{c11, c12, c22, g};
  EXPECT_FALSE(offset_yield(curve, m, 0.002));
  EXPECT_FALSE(dissipation_yield(curve, m, 1));
}

TEST(Invariants, AreThoseOfTheStress) {
  const YieldPoint point{0, {-10e6, -40e6, 0, -25e6}, {}, {}};
  EXPECT_DOUBLE_EQ(point.pressure(), 25e6);
  EXPECT_NEAR(point.deviatoric(), std::sqrt(675.0) * 1e6, 1);  // (30^2 + 15^2 + 15^2)/2
  EXPECT_DOUBLE_EQ(point.plane_pressure(), 25e6);
  EXPECT_DOUBLE_EQ(point.plane_shear(), 15e6);
}

}  // namespace
}  // namespace pulvis
