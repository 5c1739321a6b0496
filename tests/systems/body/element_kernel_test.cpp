// The mean-dilatation quad: kinematics, and forces as the derivative of its stored energy.
#include "systems/body/element_kernel.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "systems/body/j2_kernel.hpp"
#include "tests/systems/body/quads.hpp"

namespace pulvis::kernels {
namespace {

constexpr double round_off = 4e-16;  // a few units of the last place of numbers near one

Matrix2<double> near_one(Random& random, double noise) {
  return {1 + random.in(-noise, noise), random.in(-noise, noise), random.in(-noise, noise),
          1 + random.in(-noise, noise)};
}

// One element: undeformed geometry, elastic constants and a plastic state that does not change.
struct TestQuad {
  double inverse[4][4], volume[4], area = 0;
  Symmetric3<double> c[4]{};
  double mu = 1.0, bulk = 2.2, thickness = 0.7;

  explicit TestQuad(const Coordinates& undeformed) {
    for (int g = 0; g < 4; ++g) {
      const auto a = map_gradient(map_of(undeformed), gauss_xi[g], gauss_eta[g]);
      volume[g] = determinant(a);
      const double rows[4] = {a.yy, -a.xy, -a.yx, a.xx};
      for (int k = 0; k < 4; ++k) inverse[g][k] = rows[k] / volume[g];
      area += volume[g];
    }
  }
  Matrix2<double> gradient(const Coordinates& x, int g) const {
    return deformation_gradient(map_gradient(map_of(x), gauss_xi[g], gauss_eta[g]), inverse[g]);
  }
  double dilatation(const Coordinates& x) const {
    double now = 0;
    for (int g = 0; g < 4; ++g)
      now += determinant(map_gradient(map_of(x), gauss_xi[g], gauss_eta[g]));
    return now / area;
  }
  double energy(const Coordinates& x) const {
    double stored = area * volumetric_energy(bulk, dilatation(x));
    for (int g = 0; g < 4; ++g) stored += volume[g] * isochoric_energy(gradient(x, g), c[g], mu);
    return thickness * stored;
  }
  Coordinates forces(const Coordinates& x) const {
    const double theta = dilatation(x), p = mean_stress(bulk, theta);
    QuadFlux<double> flux;
    for (int g = 0; g < 4; ++g) {
      const auto a = map_gradient(map_of(x), gauss_xi[g], gauss_eta[g]);
      const auto f = gradient(x, g);
      const double r = inverse_cube_root(determinant(f));
      const auto s = scaled_deviator(left_cauchy_green(f, c[g]), mu / theta * r * r);
      const double kirchhoff = theta * volume[g] / determinant(a);
      add_flux(flux, a, kirchhoff * s.xx + p, kirchhoff * s.yy + p, kirchhoff * s.xy, gauss_xi[g],
               gauss_eta[g]);
    }
    const auto out = node_forces(flux, 0.25 * thickness);
    return {out.x[0], out.y[0], out.x[1], out.y[1], out.x[2], out.y[2], out.x[3], out.y[3]};
  }
};

// A random inverse plastic metric of unit determinant, less one.
Symmetric3<double> frozen_metric(Random& random) {
  const double xx = random.in(-0.3, 0.3), yy = random.in(-0.3, 0.3), xy = random.in(-0.3, 0.3);
  return {xx, yy, 1 / ((1 + xx) * (1 + yy) - xy * xy) - 1, xy};
}

struct Case {
  TestQuad quad;
  Coordinates x;
};

// Distorted quads under finite, uneven deformation; every second one with a plastic past.
std::vector<Case> random_cases() {
  Random random(7);
  std::vector<Case> cases;
  for (int i = 0; i < 20; ++i) {
    const Coordinates undeformed = distorted_square(random);
    Case c{TestQuad(undeformed), moved(undeformed, near_one(random, 0.3))};
    for (double& v : c.x) v += random.in(-0.1, 0.1);
    if (i % 2 == 1)
      for (auto& metric : c.quad.c) metric = frozen_metric(random);
    cases.push_back(c);
  }
  return cases;
}

double largest(const Coordinates& f) {
  double maximum = 0;
  for (const double v : f) maximum = std::max(maximum, std::abs(v));
  return maximum;
}

TEST(ElementKinematics, MapPutsTheCornersWhereTheNodesAre) {
  Random random(1);
  const Coordinates x = distorted_square(random);
  const auto m = map_of(x);
  const double xi[4] = {-1, 1, 1, -1}, eta[4] = {-1, -1, 1, 1};
  const double centre = 0.25 * (x[0] + x[2] + x[4] + x[6]);
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_NEAR(centre + m.ax * xi[k] + m.bx * eta[k] + m.hx * xi[k] * eta[k], x[2 * k], round_off);
}

TEST(ElementKinematics, AffineMotionIsReproducedAtEveryPoint) {
  Random random(2);
  for (int i = 0; i < 100; ++i) {
    const Coordinates undeformed = distorted_square(random);
    const auto f = near_one(random, 0.4);
    const TestQuad quad(undeformed);
    for (int g = 0; g < 4; ++g) {
      const auto found = quad.gradient(moved(undeformed, f), g);
      ASSERT_NEAR(found.xx, f.xx, 20 * round_off);  // positions of size 5, inverse of size 2
      ASSERT_NEAR(found.xy, f.xy, 20 * round_off);
      ASSERT_NEAR(found.yx, f.yx, 20 * round_off);
      ASSERT_NEAR(found.yy, f.yy, 20 * round_off);
    }
  }
}

TEST(ElementKinematics, RigidRotationIsNoDeformation) {
  Random random(3);
  const Coordinates undeformed = distorted_square(random);
  const TestQuad quad(undeformed);
  const auto r = rotation(1.1);
  const Coordinates x = moved(undeformed, r);
  for (int g = 0; g < 4; ++g) {
    EXPECT_NEAR(quad.gradient(x, g).xx, r.xx, 20 * round_off);
    EXPECT_NEAR(quad.gradient(x, g).yx, r.yx, 20 * round_off);
    EXPECT_NEAR(determinant(quad.gradient(x, g)), 1, 20 * round_off);
  }
  EXPECT_NEAR(quad.dilatation(x), 1, 20 * round_off);
  EXPECT_LT(largest(quad.forces(x)), 100 * round_off);  // in units of mu
}

TEST(ElementForces, AreMinusTheGradientOfTheStoredEnergy) {
  const double h = 1e-5;  // truncation h^2 = 1e-10, round-off 1e-16 E/(h f) = 1e-10
  for (const Case& c : random_cases()) {
    const Coordinates f = c.quad.forces(c.x);
    for (std::size_t i = 0; i < 8; ++i) {
      Coordinates up = c.x, down = c.x;
      up[i] += h;
      down[i] -= h;
      ASSERT_NEAR(-(c.quad.energy(up) - c.quad.energy(down)) / (2 * h), f[i], 1e-8 * largest(f))
          << i;
    }
  }
}

TEST(ElementForces, SumToNothing) {
  for (const Case& c : random_cases()) {
    const Coordinates f = c.quad.forces(c.x);
    EXPECT_NEAR(f[0] + f[2] + f[4] + f[6], 0, 4 * round_off * largest(f));
    EXPECT_NEAR(f[1] + f[3] + f[5] + f[7], 0, 4 * round_off * largest(f));
  }
}

TEST(ElementForces, HaveNoMoment) {
  for (const Case& c : random_cases()) {
    const Coordinates f = c.quad.forces(c.x);
    double moment = 0;
    for (std::size_t i = 0; i < 8; i += 2) moment += c.x[i] * f[i + 1] - c.x[i + 1] * f[i];
    EXPECT_NEAR(moment, 0,
                100 * round_off * largest(f));  // arms up to 5, eight terms, eight products each
  }
}

TEST(ElementForces, TurnWithTheElement) {
  const auto q = rotation(0.8);
  for (const Case& c : random_cases()) {
    const Coordinates before = c.quad.forces(c.x), after = c.quad.forces(moved(c.x, q));
    for (std::size_t i = 0; i < 8; i += 2) {
      EXPECT_NEAR(after[i], q.xx * before[i] + q.xy * before[i + 1], 1e-13 * largest(before));
      EXPECT_NEAR(after[i + 1], q.yx * before[i] + q.yy * before[i + 1], 1e-13 * largest(before));
    }
  }
}

TEST(ElementForces, OfUniformPressureAreThoseOfTheSides) {
  // On a side (dx, dy) of a counter-clockwise outline, tension pulls each end with half of p t (dy, -dx).
  Random random(5);
  const Coordinates x = distorted_square(random);
  QuadFlux<double> flux;
  for (int g = 0; g < 4; ++g) {
    const auto a = map_gradient(map_of(x), gauss_xi[g], gauss_eta[g]);
    add_flux(flux, a, 1.0, 1.0, 0.0, gauss_xi[g], gauss_eta[g]);
  }
  const auto f = node_forces(flux, 0.25);
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t next = 2 * ((k + 1) % 4), before = 2 * ((k + 3) % 4);
    EXPECT_NEAR(f.x[k], -0.5 * (x[next + 1] - x[before + 1]), 8 * round_off) << k;
    EXPECT_NEAR(f.y[k], 0.5 * (x[next] - x[before]), 8 * round_off) << k;
  }
}

// Relative error of y as a^(-1/3), found in higher precision.
double cube_root_error(double a, double y) {
  using Wide = long double;
  return static_cast<double>((Wide(a) * Wide(y) * Wide(y) * Wide(y) - 1) / 3);
}

TEST(InverseCubeRoot, IsRightToTheLastPlaces) {
  Random random(6);
  for (int i = 0; i < 200000; ++i) {
    const double a = std::exp(random.in(std::log(0.05), std::log(20.0)));
    // Within (0.5, 2) one rounding of the last correction; beyond, the library's cube root and a division.
    const double bound = a > 0.5 && a < 2 ? 2e-16 : 7e-16;
    ASSERT_LT(std::abs(cube_root_error(a, inverse_cube_root(a))), bound) << a;
  }
  for (const double a : {0.5, 0.8, 1.0, 1.25, 2.0})
    for (const double x : {std::nextafter(a, 0), a, std::nextafter(a, 9)})
      EXPECT_LT(std::abs(cube_root_error(x, inverse_cube_root(x))), 7e-16) << x;
  EXPECT_EQ(inverse_cube_root(1.0), 1);
}

TEST(InverseCubeRoot, LanesGiveTheBitsOfTheScalarWhateverTheirNeighbours) {
  Random random(7);
  for (int i = 0; i < 20000; ++i) {
    Lane a = i % 2 ? random.lane(0.8, 1.25) : random.lane(0.05, 3.0);
    if (i % 3 == 0) a[i % lane_count] = 17.0;
    const Lane y = inverse_cube_root(a);
    for (int l = 0; l < lane_count; ++l)
      ASSERT_EQ(bits(y[l]), bits(inverse_cube_root(a[l]))) << a[l];
  }
}

TEST(ElementKernels, LanesGiveTheBitsOfTheScalar) {
  Random random(8);
  for (int i = 0; i < 1000; ++i) {
    const Matrix2<Lane> f{random.lane(0.5, 2), random.lane(-1, 1), random.lane(-1, 1),
                          random.lane(0.5, 2)};
    const Lane det = determinant(f);
    for (int l = 0; l < lane_count; ++l) {
      const Matrix2<double> one{f.xx[l], f.xy[l], f.yx[l], f.yy[l]};
      ASSERT_EQ(bits(det[l]), bits(determinant(one)));
    }
  }
}

}  // namespace
}  // namespace pulvis::kernels
