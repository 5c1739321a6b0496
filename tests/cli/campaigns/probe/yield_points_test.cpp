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
  curve.direction.angle = angle;
  double xx = 0, yy = 0, spent = 0;
  constexpr int steps = 4000;
  const double dx = 0.02 / steps * std::cos(angle), dy = 0.02 / steps * std::sin(angle);
  for (int i = 0; i <= steps; ++i) {
    curve.strain.push_back(mandel_of({i * dx, i * dy}));
    curve.stress.push_back(mandel_of({xx, yy, 0.3 * (xx + yy)}));
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
    shear.strain.push_back(mandel_of({0, 0, 0, i * 1e-5}));
    shear.stress.push_back(mandel_of({0, 0, 0, 2 * g * i * 1e-5}));
  }
  std::vector<ProbeCurve> curves = all_probed();
  curves.push_back(shear);
  const PowderModuli m = moduli_of(curves, false, 2e-4);
  EXPECT_NEAR(m.c(1, 1) / c11, 1, 1e-9);
  EXPECT_NEAR(m.c(1, 2) / c12, 1, 1e-9);
  EXPECT_NEAR(m.c(2, 2) / c22, 1, 1e-9);
  EXPECT_NEAR(m.c(4, 4) / g, 1, 1e-9);
  EXPECT_FALSE(m.has(3));
  EXPECT_FALSE(moduli_of(all_probed(), false, 2e-4).has(4));  // its shear probe failed
}

MandelMatrix stiffness(double a, double b, double c, double shear) {
  MandelMatrix m = MandelMatrix::Zero();
  m(0, 0) = a, m(0, 1) = m(1, 0) = b, m(1, 1) = c, m(3, 3) = 2 * shear;
  return m;
}
const std::vector<int> plane_parts{0, 1, 3}, all_parts{0, 1, 2, 3, 4, 5};

constexpr double e = 70e9, nu = 0.3, lambda = e * nu / ((1 + nu) * (1 - 2 * nu)),
                 mu = e / (2 + 2 * nu);

MandelMatrix isotropic_solid() {
  MandelMatrix m = 2 * mu * MandelMatrix::Identity();
  m.topLeftCorner<3, 3>().array() += lambda;
  return m;
}

TEST(PowderModuli, GiveBackAnIsotropicSolid) {
  const PowderModuli plane(stiffness(lambda + 2 * mu, lambda, lambda + 2 * mu, mu), plane_parts,
                           false);
  const PowderModuli space(isotropic_solid(), all_parts, true);
  for (const PowderModuli* m : {&plane, &space}) {
    EXPECT_NEAR(m->youngs_modulus() / e, 1, 1e-12);
    EXPECT_NEAR(m->poissons_ratio(), nu, 1e-12);
  }
  EXPECT_NEAR(space.misfits().isotropic, 0, 1e-12);
  for (const auto& [name, value] : space.engineering_constants())
    EXPECT_NEAR(value / (name[0] == 'E' ? e : name[0] == 'n' ? nu : mu), 1, 1e-12) << name;
}

// Turned about its own axis a transversely isotropic solid is the same; turned about another one it is none of the three.
TEST(PowderModuli, TellTheSymmetryOfASolid) {
  MandelMatrix layered = isotropic_solid();
  layered(2, 2) *= 1.5, layered(4, 4) *= 0.7, layered(5, 5) *= 0.7;
  const PowderModuli transverse(layered, all_parts, true);
  EXPECT_GT(transverse.misfits().isotropic, 0.05);
  EXPECT_NEAR(transverse.misfits().transverse, 0, 1e-12);
  EXPECT_LT(transverse.engineering_constants()[0].second,
            transverse.engineering_constants()[2].second);

  // Strains and stresses of a solid whose axes have been turned by 30 degrees about y.
  const double c = std::cos(pi / 6), s = std::sin(pi / 6);
  const Eigen::Matrix3d turn{{c, 0, s}, {0, 1, 0}, {-s, 0, c}};
  const auto turned = [&](const Mandel& m) {
    const TensorParts t = parts_of(m);
    const Eigen::Matrix3d whole{{t[0], t[3], t[5]}, {t[3], t[1], t[4]}, {t[5], t[4], t[2]}};
    const Eigen::Matrix3d there = turn.transpose() * whole * turn;
    return mandel_of(
        {there(0, 0), there(1, 1), there(2, 2), there(0, 1), there(1, 2), there(2, 0)});
  };
  MandelMatrix basis;
  for (int k = 0; k < 6; ++k) basis.col(k) = turned(Mandel::Unit(k));
  const PowderModuli oblique(basis.transpose() * layered * basis, all_parts, true);
  EXPECT_NEAR(oblique.youngs_modulus() / transverse.youngs_modulus(), 1, 1e-12);
  EXPECT_NEAR(oblique.misfits().isotropic, transverse.misfits().isotropic, 1e-12);
  EXPECT_GT(oblique.misfits().orthotropic, 0.02);
  EXPECT_GT(oblique.misfits().transverse, oblique.misfits().orthotropic);
}

TEST(PowderModuli, OfAnElasticSolidTakeEnergyForEveryStrain) {
  const auto is_solid = [](double a, double b, double c, double shear) {
    return PowderModuli(stiffness(a, b, c, shear), plane_parts, false).are_of_a_solid();
  };
  EXPECT_TRUE(is_solid(c11, c12, c22, g));
  EXPECT_FALSE(is_solid(c11, 1.01 * std::sqrt(c11 * c22), c22, g));
  EXPECT_FALSE(is_solid(-c11, 0, -c22, g));
  EXPECT_FALSE(is_solid(c11, c12, c22, -g));
}

// All six components: a solid is strained as a probe in three dimensions does.
TEST(PowderModuli, InThreeDimensionsComeFromTheDirectionsOfAProbe) {
  MandelMatrix solid = isotropic_solid();
  solid(0, 0) *= 1.3, solid(3, 3) *= 0.8, solid(0, 4) = solid(4, 0) = 3e9;
  std::vector<ProbeCurve> curves;
  for (const ProbeDirection& direction : directions_of({}, true)) {
    ProbeCurve& curve = curves.emplace_back();
    curve.direction = direction;
    for (int i = 0; i < 10; ++i) {
      curve.strain.push_back(i * 1e-5 * direction.unit);
      curve.stress.push_back(-mandel_of({1e6, 2e6, 3e6}) + solid * curve.strain.back());
    }
  }
  const PowderModuli m = moduli_of(curves, true, 2e-4);
  ASSERT_TRUE(m.is_complete());
  EXPECT_NEAR(m.c(1, 1) / solid(0, 0), 1, 1e-9);
  EXPECT_NEAR(m.c(4, 4) / (0.8 * mu), 1, 1e-9);
  EXPECT_NEAR(m.c(1, 5) / (3e9 / std::sqrt(2)), 1, 1e-9);
  EXPECT_NEAR(m.elastic_strain(solid.col(1))[1], 1, 1e-9);
}

TEST(YieldPoints, AreOnTheSurfaceAndFlowAlongItsNormal) {
  const std::vector<ProbeCurve> curves = all_probed();
  const PowderModuli m = moduli_of(curves, false, 2e-4);
  std::vector<YieldPoint> points;
  for (const ProbeCurve& curve : curves) {
    const auto by_offset = offset_yield(curve, m, 0.002);
    const auto by_energy = dissipation_yield(curve, m, 0.002 * yield);
    ASSERT_TRUE(by_offset && by_energy) << curve.direction.angle;
    for (const auto& point : {*by_offset, *by_energy})
      EXPECT_NEAR(std::hypot(point.stress[0], point.stress[1]) / yield, 1, 1e-3)
          << curve.direction.angle;
    points.push_back(*by_offset);
  }
  find_normality(points, Mandel::Zero(), 24);
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
    point.direction.angle = 2 * pi * k / 24;
    const double side = k < 12 ? 1 : -1, along = std::abs(k - 12);
    point.stress = mandel_of({-along, side * along});
    point.plastic = mandel_of({std::sqrt(0.5), side * std::sqrt(0.5)});
    points.push_back(point);
  }
  find_normality(points, mandel_of({-8}), 24);
  for (const YieldPoint& point : points) {
    const double k = std::round(point.direction.angle * 24 / (2 * pi));
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
    point.direction.angle = 2 * pi * k / 12;
    const double turned = k == 2 ? 3.0 : k == 3 ? 2.0 : k;
    point.stress = mandel_of({std::cos(2 * pi * turned / 12), std::sin(2 * pi * turned / 12)});
    point.plastic = point.stress;
    points.push_back(point);
  }
  find_normality(points, Mandel::Zero(), 12);
  for (const YieldPoint& point : points) {
    const double k = std::round(point.direction.angle * 12 / (2 * pi));
    EXPECT_EQ(point.normality.has_value(), k != 5 && k != 7) << k;
    EXPECT_NEAR(point.normality.value_or(0), 0, 1e-7) << k;
  }
}

TEST(YieldPoints, AreMissingWhereNothingYields) {
  ProbeCurve curve;
  for (int i = 0; i < 10; ++i) {
    curve.strain.push_back(mandel_of({i * 1e-4}));
    curve.stress.push_back(mandel_of({c11 * i * 1e-4, c12 * i * 1e-4}));
    curve.dissipated.push_back(0);
  }
  const PowderModuli m(stiffness(c11, c12, c22, g), plane_parts, false);
  EXPECT_FALSE(offset_yield(curve, m, 0.002));
  EXPECT_FALSE(dissipation_yield(curve, m, 1));
}

TEST(Invariants, AreThoseOfTheStress) {
  YieldPoint point;
  point.stress = mandel_of({-10e6, -40e6, -25e6});
  EXPECT_DOUBLE_EQ(point.pressure(), 25e6);
  EXPECT_NEAR(point.deviatoric(), std::sqrt(675.0) * 1e6, 1);  // (30^2 + 15^2 + 15^2)/2
  EXPECT_DOUBLE_EQ(point.plane_pressure(), 25e6);
  EXPECT_DOUBLE_EQ(point.plane_shear(), 15e6);
  point.axis = Axis::z;
  point.stress = mandel_of({-10e6, -10e6, -40e6});
  EXPECT_NEAR(point.deviatoric(), 30e6, 1e-3);
  EXPECT_NEAR(lode_angle(point.stress), 0, 1e-9);
  EXPECT_NEAR(lode_angle(mandel_of({-10e6, -40e6, -10e6})), 2 * pi / 3, 1e-9);
  EXPECT_NEAR(lode_angle(mandel_of({-40e6, -40e6, -10e6})), pi, 1e-9);
  point.stress = mandel_of({-40e6, -40e6, -10e6, 5e6});
  EXPECT_NEAR(point.deviatoric(), -std::sqrt(900.0 + 75) * 1e6, 1e-3);
}

}  // namespace
}  // namespace pulvis
