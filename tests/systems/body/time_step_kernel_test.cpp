// The frequency bound of a quad against closed forms and against the exact second derivative of its energy.
#include "systems/body/time_step_kernel.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>

#include "systems/body/element_kernel.hpp"
#include "tests/helpers/random_values.hpp"

namespace pulvis::kernels {
namespace {

constexpr Shape::CornerMoment quarters{1, 0, 1};  // a quarter of the mass at each corner

TEST(FrequencyBound, OfASquareIsItsVolumeMode) {
  const double bulk = 3, mu = 2, half = 0.25;
  const auto n = mode_spread(Matrix2<double>{half, 0.0, 0.0, half}, quarters);
  // All corners move outwards: rho omega^2 = (lambda + mu) 2 / (h/2)^2.
  const double lambda = bulk - 2 * mu / 3;
  EXPECT_NEAR(frequency_bound(n, bulk, mu, 1.0, 0.0), 2 * (lambda + mu) / (half * half), 1e-10);
}

TEST(FrequencyBound, OfALongElementIsTheBarAcrossIt) {
  const double bulk = 3, mu = 2, half = 0.25;
  const auto n = mode_spread(Matrix2<double>{1e4 * half, 0.0, 0.0, half}, quarters);
  EXPECT_NEAR(frequency_bound(n, bulk, mu, 1.0, 0.0), (bulk + 4 * mu / 3) / (half * half), 1e-4);
}

TEST(FrequencyBound, DoesNotDependOnTheFrame) {
  const Matrix2<double> a{0.5, 0.2, -0.1, 0.4};
  const auto n = mode_spread(a, {1.2, 0.1, 0.9});
  const double c = std::cos(1.1), s = std::sin(1.1);
  const auto turned = mode_spread(Matrix2<double>{c * a.xx - s * a.yx, c * a.xy - s * a.yy,
                                                  s * a.xx + c * a.yx, s * a.xy + c * a.yy},
                                  {1.2, 0.1, 0.9});
  EXPECT_NEAR(turned.trace, n.trace, 1e-13 * n.trace);
  EXPECT_NEAR(turned.det, n.det, 1e-13 * n.det);
}

TEST(EdgeSpring, OfEqualNodesIsTheirCommonMode) {
  EXPECT_DOUBLE_EQ(edge_spring_frequency(0.3, 0.5, 0.5), 0.5 * 0.3 / 0.5);
  // One heavy end: the spring matrix's diagonal over the light one.
  EXPECT_NEAR(edge_spring_frequency(0.3, 0.5, 1e12), 0.3 / 3 / 0.5, 1e-10);
}

// ---- against the element itself ---------------------------------------------------------------------
using Coordinates = Eigen::Matrix<double, 8, 1>;  // x0 y0 x1 y1 ...

struct Element {
  Coordinates undeformed;
  double bulk, mu;

  static QuadMap<double> map(const Coordinates& x) {
    return quad_map(x[0], x[1], x[2], x[3], x[4], x[5], x[6], x[7]);
  }
  Matrix2<double> at(const Coordinates& x, int g) const {
    return map_gradient(map(x), gauss_xi[g], gauss_eta[g]);
  }
  double area(const Coordinates& x) const {
    double sum = 0;
    for (int g = 0; g < 4; ++g) sum += determinant(at(x, g));
    return sum;
  }
  double min_area(const Coordinates& x) const {
    double minimum = 1e300;
    for (int g = 0; g < 4; ++g) minimum = std::min(minimum, determinant(at(x, g)));
    return minimum;
  }
  Matrix2<double> gradient(const Coordinates& x, int g) const {
    const auto a0 = at(undeformed, g);
    const double j0 = determinant(a0);
    return deformation_gradient(
        at(x, g), std::array<double, 4>{a0.yy / j0, -a0.xy / j0, -a0.yx / j0, a0.xx / j0});
  }
  // K/2 ((theta^2-1)/2 - ln theta) of the element and the neo-Hookean deviator of its points.
  double energy(const Coordinates& x) const {
    const double area0 = area(undeformed), theta = area(x) / area0;
    double sum = area0 * 0.5 * bulk * (0.5 * (theta * theta - 1) - std::log(theta));
    for (int g = 0; g < 4; ++g) {
      const auto f = gradient(x, g);
      const double trace = f.xx * f.xx + f.xy * f.xy + f.yx * f.yx + f.yy * f.yy + 1;
      sum += determinant(at(undeformed, g)) * 0.5 * mu *
             (std::pow(determinant(f), -2.0 / 3) * trace - 3);
    }
    return sum;
  }
  // |dev b'| of the worst point.
  double distortion(const Coordinates& x) const {
    double worst = 0;
    for (int g = 0; g < 4; ++g) {
      const auto f = gradient(x, g);
      Eigen::Matrix3d f3 = Eigen::Matrix3d::Identity();
      f3.topLeftCorner<2, 2>() << f.xx, f.xy, f.yx, f.yy;
      const Eigen::Matrix3d b = std::pow(determinant(f), -2.0 / 3) * f3 * f3.transpose();
      worst = std::max(worst, (b - b.trace() / 3 * Eigen::Matrix3d::Identity()).norm());
    }
    return worst;
  }
  // Exact rho omega^2 with a quarter of the mass at each corner.
  double highest(const Coordinates& x) const {
    const double h = 1e-4;
    Eigen::Matrix<double, 8, 8> hessian;
    for (int i = 0; i < 8; ++i)
      for (int j = 0; j < 8; ++j) {
        const auto moved = [&](double a, double b) {
          Coordinates y = x;
          y[i] += a * h;
          y[j] += b * h;
          return energy(y);
        };
        hessian(i, j) = (moved(1, 1) - moved(1, -1) - moved(-1, 1) + moved(-1, -1)) / (4 * h * h);
      }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 8, 8>> solver(
        0.5 * (hessian + hessian.transpose()));
    return solver.eigenvalues().maxCoeff() / (area(undeformed) / 4);
  }
  double bound(const Coordinates& x) const {
    return frequency_bound(mode_spread(map_gradient(map(x), 0, 0), quarters), bulk, mu,
                           area(x) / area(undeformed), distortion(x));
  }
};

// Distorted elements, from steel to nearly incompressible, stretched by up to one half: no element swings
// faster than its bound (0.5% for the hourglass part of badly distorted ones), and the bound is not idle.
TEST(FrequencyBound, HoldsForStrainedElements) {
  Random random(11);
  int done = 0;
  double closest = 0;
  while (done < 1500) {
    Element e;
    const double aspect = random.in(0.4, 2.5), noise = done % 2 ? 0.12 * std::min(aspect, 1.0) : 0;
    e.undeformed << -aspect / 2, -0.5, aspect / 2, -0.5, aspect / 2, 0.5, -aspect / 2, 0.5;
    for (int i = 0; i < 8; ++i) e.undeformed[i] += random.in(-noise, noise);
    const double nu = std::array{0.0, 0.3, 0.45, 0.4999}[static_cast<std::size_t>(done % 4)];
    e.mu = 1;
    e.bulk = 2 * (1 + nu) / (3 * (1 - 2 * nu));
    const double strain = 0.5 * (done % 6) / 5;
    const Eigen::Matrix2d f = Eigen::Matrix2d::Identity() + Eigen::Matrix2d::NullaryExpr([&] {
                                return random.in(-strain, strain);
                              });
    Coordinates x;
    for (int n = 0; n < 4; ++n) x.segment<2>(2 * n) = f * e.undeformed.segment<2>(2 * n);
    if (e.min_area(e.undeformed) < 0.02 || e.min_area(x) < 0.02) continue;
    const double ratio = e.highest(x) / e.bound(x);
    EXPECT_LT(ratio, 1.01) << "nu " << nu << ", strain " << strain << ", aspect " << aspect;
    closest = std::max(closest, ratio);
    done += 1;
  }
  EXPECT_GT(closest, 0.99);
}

}  // namespace
}  // namespace pulvis::kernels
