// Plastic flow of bodies in three dimensions: steel_yield surface, closed forms of homogeneous flow, work and dissipation.
#include <gtest/gtest.h>

#include "tests/systems/space/body/blocks.hpp"

namespace pulvis::space {
namespace {

template <class F>
class Flow3 : public testing::Test {};
TYPED_TEST_SUITE(Flow3, Formulations);

constexpr double steel_modulus = 200, steel_yield = 0.4, steel_hardening = 2;  // of steel, in GPa

double effective(const Matrix& stress) {
  const Matrix s = stress - stress.trace() / 3 * Matrix::Identity();
  return std::sqrt(1.5) * s.norm();
}

template <class F>
Body<F> element(std::optional<double> h = steel_hardening) {
  return Body<F>(distorted_block({1, 1, 1}, 0.2, 1), material(steel_modulus, 0.3, steel_yield, *h));
}

template <class F>
void deform(Body<F>& body, const Matrix& f) {
  body.place([&](const Vector& x) { return Vector(f * x); });
  body.find_forces();
}

// Wherever it flows, the stress is the flow stress, and plastic strain never falls: along a wandering deformation.
TYPED_TEST(Flow3, ReturnEndsOnTheSurface) {
  auto body = element<TypeParam>();
  Random random(2);
  Matrix f = Matrix::Identity();
  int flowed = 0;
  for (int i = 0; i < 300; ++i) {
    for (int k = 0; k < 9; ++k) f(k / 3, k % 3) += random.in(-0.01, 0.01);
    f = (Matrix::Identity() + 0.99 * (f - Matrix::Identity())).eval();
    const double before = body.template number<PlasticStrain<TypeParam::points>>(0);
    deform(body, f);
    const double eps = body.template number<PlasticStrain<TypeParam::points>>(0);
    const double limit = steel_yield + steel_hardening * eps;
    ASSERT_GE(eps, before);
    if (eps > before) {
      ++flowed;
      ASSERT_NEAR(effective(body.cauchy(0)) / limit, 1, 1e-9);
    } else {
      ASSERT_LE(effective(body.cauchy(0)), limit * (1 + 1e-9));
    }
  }
  EXPECT_GT(flowed, 100);
}

// det C_p^-1 stays 1: plastic flow keeps volume. What one step leaves is of eighth order in the elastic strain.
TYPED_TEST(Flow3, PlasticFlowKeepsVolume) {
  auto body = element<TypeParam>();
  Random random(3);
  Matrix f = Matrix::Identity();
  for (int i = 0; i < 300; ++i) {
    for (int k = 0; k < 9; ++k) f(k / 3, k % 3) += random.in(-0.01, 0.01);
    f = (Matrix::Identity() + 0.99 * (f - Matrix::Identity())).eval();
    deform(body, f);
  }
  const auto c = [&](int k) {
    return body.template number<CpInverse<ThreeD, TypeParam::points>>(0, k);
  };
  Matrix metric;
  metric << 1 + c(0), c(3), c(5), c(3), 1 + c(1), c(4), c(5), c(4), 1 + c(2);
  EXPECT_NEAR(metric.determinant(), 1, 1e-12);
  EXPECT_GT((metric - Matrix::Identity()).norm(), 0.01);
}

// Simple shear: tau = (sigma_y + H eps)/sqrt 3 with eps = gamma_p/sqrt 3, but for the elastic strain.
TYPED_TEST(Flow3, SimpleShear) {
  auto body = element<TypeParam>();
  Matrix f = Matrix::Identity();
  for (int i = 0; i < 1000; ++i) {
    f(0, 1) += 1e-3;
    deform(body, f);
  }
  const double mu = steel_modulus / 2.6, tau = body.cauchy(0)(0, 1);
  const double eps = (1 - tau / mu) / std::sqrt(3.0);
  EXPECT_NEAR(body.template number<PlasticStrain<TypeParam::points>>(0), eps, 0.003 * eps);
  EXPECT_NEAR(tau, (steel_yield + steel_hardening * eps) / std::sqrt(3.0), 0.005 * tau);
}

// Tension along x with free sides: sigma = sigma_y + H eps, ln(l/l0) = sigma/E + eps.
TYPED_TEST(Flow3, UniaxialTension) {
  auto body = element<TypeParam>();
  double side = 1;
  for (int i = 1; i <= 200; ++i) {
    const double stretch = 1 + 1e-3 * i;
    // The sides follow so that they bear nothing: from the state of the step before, by the secant of a trial.
    const auto saved = [&] {
      std::vector<double> values;
      for (int k = 0; k < 6 * TypeParam::points; ++k)
        values.push_back(body.template number<CpInverse<ThreeD, TypeParam::points>>(0, k));
      for (int k = 0; k < TypeParam::points; ++k)
        values.push_back(body.template number<PlasticStrain<TypeParam::points>>(0, k));
      return values;
    }();
    const auto side_stress = [&](double s) {
      std::size_t at = 0;
      for (int k = 0; k < 6 * TypeParam::points; ++k)
        body.template number<CpInverse<ThreeD, TypeParam::points>>(0, k) = saved[at++];
      for (int k = 0; k < TypeParam::points; ++k)
        body.template number<PlasticStrain<TypeParam::points>>(0, k) = saved[at++];
      deform(body, Vector(stretch, s, s).asDiagonal());
      return body.cauchy(0)(1, 1);
    };
    double low = side - 1e-3, high = side + 5e-4;
    for (int k = 0; k < 40; ++k) {
      const double middle = (low + high) / 2;
      (side_stress(middle) > 0 ? high : low) = middle;
    }
    side = (low + high) / 2;
    side_stress(side);
  }
  const double sigma = body.cauchy(0)(0, 0);
  const double eps = std::log(1.2) - sigma / steel_modulus;
  // Box 9.1 has tr b/3 where the flow rule has b.
  const double of_elastic_strain = sigma / steel_modulus;
  EXPECT_NEAR(body.template number<PlasticStrain<TypeParam::points>>(0), eps,
              of_elastic_strain * eps);
  EXPECT_NEAR(sigma, steel_yield + steel_hardening * eps, of_elastic_strain * sigma);
}

// What nodes are moved with is stored or spent, also by the hourglass modes: small steps along a path of random goals.
TYPED_TEST(Flow3, WorkIsStoredOrSpent) {
  Body<TypeParam> body(distorted_block({2, 1, 1}, 0.2, 4),
                       material(steel_modulus, 0.3, steel_yield, steel_hardening));
  Random random(5);
  std::vector<Vector> start, force;
  body.find_forces();
  for (int n = 0; n < body.nodes(); ++n) start.push_back(body.position(n));
  double work = 0, spent = 0;
  const auto spent_now = [&] {
    body.template run<plastic_work<TypeParam>>();
    double sum = body.template number<PlasticWork>(0);
    if constexpr (TypeParam::stabilised) sum += body.template number<HourglassWork>(0);
    return sum;
  };
  for (int goal = 0; goal < 8; ++goal) {
    std::vector<Vector> step;
    for (int n = 0; n < body.nodes(); ++n) {
      const double x = random.in(-1, 1), y = random.in(-1, 1);
      const Vector to = start[std::size_t(n)] + 0.05 * Vector(x, y, random.in(-1, 1));
      step.push_back((to - body.position(n)) / 400);
    }
    for (int i = 0; i < 400; ++i) {
      for (int n = 0; n < body.nodes(); ++n) {
        work -= 0.5 * body.force(n).dot(step[std::size_t(n)]);
        body.put(n, body.position(n) + step[std::size_t(n)]);
      }
      body.find_forces();
      for (int n = 0; n < body.nodes(); ++n) work -= 0.5 * body.force(n).dot(step[std::size_t(n)]);
      const double now = spent_now();
      ASSERT_GE(now, spent * (1 - 1e-12));
      spent = now;
    }
  }
  const double stored = body.stored_energy();
  EXPECT_GT(spent, 0.2 * stored);
  // Work is sigma_y eps but for the square of the elastic strain.
  EXPECT_NEAR(work, stored + spent, 0.01 * spent);
  if constexpr (TypeParam::stabilised) {
    EXPECT_GT(body.template number<HourglassWork>(0), 0.05 * spent);
  }
}

// Curved laws take the same way as the line, through the iteration: Swift with n = 1 is one.
TYPED_TEST(Flow3, CurvedLawsMeetTheLine) {
  const Shape shape = distorted_block({2, 1, 1}, 0.2, 6);
  MaterialSpec curved = material(steel_modulus, 0.3, steel_yield, 0);
  FlowLaw law;
  law.hardening = pulvis::kernels::SwiftHardening{steel_yield, steel_yield / steel_hardening, 1};
  curved.flow = std::make_shared<FlowLaw>(law);
  Body<TypeParam> by_line(shape, material(steel_modulus, 0.3, steel_yield, steel_hardening)),
      by_curve(shape, curved);
  Random random(7);
  for (int i = 0; i < 50; ++i) {
    for (int n = 0; n < by_line.nodes(); ++n) {
      const double x = random.in(-1, 1), y = random.in(-1, 1);
      const Vector to = by_line.position(n) + 2e-4 * Vector(x, y, random.in(-1, 1));
      by_line.put(n, to);
      by_curve.put(n, to);
    }
    by_line.find_forces();
    by_curve.find_forces();
    EXPECT_LT(std::abs(by_curve.template number<ReturnResidual>(0)), 1e-12);
  }
  const double eps = by_line.template number<PlasticStrain<TypeParam::points>>(0);
  EXPECT_GT(eps, 1e-3);
  // The same but for the linear step of the joint surface, which is of first order in the step.
  EXPECT_NEAR(by_curve.template number<PlasticStrain<TypeParam::points>>(0), eps,
              TypeParam::stabilised ? 0.05 * eps : 1e-9 * eps);
}

}  // namespace
}  // namespace pulvis::space
