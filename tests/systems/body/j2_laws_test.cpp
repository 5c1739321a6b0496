// The iterated return: stresses on the curve of their law, and what happens where there is none.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "systems/body/j2_bending_kernel.hpp"
#include "tests/helpers/random_values.hpp"

namespace pulvis::kernels {
namespace {

constexpr double mu = 80e9;

template <class T>
J2State<T> law_trial(const Matrix2<T>& f, const J2State<T>& old) {
  const T theta = determinant(f), r = inverse_cube_root(theta);
  return {scaled_deviator(left_cauchy_green(f, old.c), mu / theta * (r * r)), old.c, old.eps};
}
template <class T, class Law>
Returned<T> law_step(const Matrix2<T>& f, const J2State<T>& old, const Law& law) {
  const T theta = determinant(f), r = inverse_cube_root(theta);
  return radial_return<T>(law_trial(f, old), f, r * r, mu / theta, theta / mu, law);
}
template <class T>
T mises(const J2State<T>& s) {
  return sqrt(1.5 * squared_norm(s.s));
}

const VoceHardening voce{240e6, 180e6, 25};
const SwiftHardening swift{240e6, 0.01, 0.25};
const LudwikHardening ludwik{240e6, 500e6, 0.4};  // upright where flow begins
const TabulatedHardening table{{0, 0.02, 0.1, 0.5}, {240e6, 280e6, 320e6, 900e6}};
const CowperSymonds rate{40, 5};

// Random paths with steps from far below the elastic limit to ten times it.
template <class Law, class Look>
void along_paths(const Law& law, const Look& look) {
  Random random(7);
  int flowed = 0;
  for (int path = 0; path < 60; ++path) {
    Matrix2<double> f{1, 0, 0, 1};
    Returned<double> state{};
    for (int i = 0; i < 200; ++i) {
      const double size = std::pow(10, random.in(-7, -1.7));
      for (double* v : {&f.xx, &f.xy, &f.yx, &f.yy}) *v += size * random.in(-1, 1);
      const Returned<double> next = law_step(f, J2State<double>(state), law);
      look(J2State<double>(state), next);
      if (testing::Test::HasFatalFailure()) return;
      flowed += next.eps > state.eps;
      state = next;
    }
  }
  EXPECT_GT(flowed, 3000);  // of 12000
}

template <class Law>
void expect_on_curve(const Law& law) {
  along_paths(law, [&](const J2State<double>& old, const Returned<double>& next) {
    ASSERT_EQ(next.residual, 0);
    const double ratio = mises(next) / law.flow_stress(next.eps);
    ASSERT_LE(ratio, 1 + 2e-12);
    // eps is rounded: where the curve is steep that shows.
    const double rounding = 1e-16 * law.modulus(next.eps) / law.flow_stress(next.eps);
    if (next.eps > old.eps) {
      ASSERT_NEAR(ratio, 1, 2e-12 + rounding) << next.eps;
    }
  });
}
TEST(IteratedReturn, EndsOnTheCurve) {
  expect_on_curve(voce);
  expect_on_curve(swift);
  expect_on_curve(ludwik);
  expect_on_curve(table);
}

TEST(IteratedReturn, OfALineIsTheClosedForm) {
  const LinearHardening<double> linear{240e6, 440e6};
  const TabulatedHardening line{{0, 1}, {240e6, 680e6}};
  along_paths(linear, [&](const J2State<double>& old, const Returned<double>& next) {
    static_cast<void>(old);
    ASSERT_EQ(next.residual, 0);
  });
  Random random(3);
  for (int i = 0; i < 2000; ++i) {
    const Matrix2<double> f{1 + random.in(-0.02, 0.02), random.in(-0.02, 0.02),
                            random.in(-0.02, 0.02), 1 + random.in(-0.02, 0.02)};
    const auto a = law_step(f, J2State<double>{}, linear), b = law_step(f, J2State<double>{}, line);
    ASSERT_NEAR(a.eps, b.eps, 1e-14);
    ASSERT_NEAR(a.s.xx, b.s.xx, 1e-12 * mu * 0.02);
    ASSERT_NEAR(a.c.xy, b.c.xy, 1e-14);
  }
}

// A jump within 1e-12 of strain is not resolved by the strain, whose last digit is 1e-17: the return ends in it.
TEST(IteratedReturn, EndsWithinAJump) {
  const TabulatedHardening jump{{0, 0.05, 0.05 + 1e-12, 1}, {240e6, 245e6, 300e6, 310e6}};
  J2State<double> state{};
  double maximum = 0;
  int within = 0;
  for (double gamma = 0; gamma < 0.2; gamma += 1e-4) {
    const Returned<double> next = law_step(Matrix2<double>{1, gamma, 0, 1}, state, jump);
    ASSERT_EQ(next.residual, 0) << gamma;
    maximum = std::max(maximum, mises(next) / jump.flow_stress(next.eps) - 1);
    within += next.eps >= 0.05 && next.eps < 0.05 + 1e-12;
    state = next;
  }
  EXPECT_GT(within, 0);
  EXPECT_LT(maximum, 1e-5);  // a last digit of the strain is 350 Pa there
  EXPECT_NEAR(mises(state), jump.flow_stress(state.eps), 1e-3);
}

// One step of every size at one rate law: the stress is that of the rate of the step.
TEST(IteratedReturn, BearsWhatTheRateOfTheStepSays) {
  for (const double dt : {1e-9, 1e-6, 1e-3, 1.0}) {
    const RatedHardening law{voce, rate, 1 / dt};
    for (double gamma = 5.3e-3; gamma < 0.1; gamma *= 1.3) {
      const auto next = law_step(Matrix2<double>{1, gamma, 0, 1}, J2State<double>{}, law);
      ASSERT_EQ(next.residual, 0);
      ASSERT_GT(next.eps, 0);
      const double flow = voce.flow_stress(next.eps) * rate.factor(next.eps / dt);
      ASSERT_NEAR(mises(next) / flow, 1, 1e-11) << dt << " " << gamma;
    }
  }
}

// Where hourglass modes flow with the deviator: both stay on the joint surface.
TEST(IteratedReturn, KeepsBendingOnTheJointSurface) {
  Random random(4);
  const double fibre = plane_strain_modulus(mu, 170e9);
  int bent = 0;
  for (int i = 0; i < 2000; ++i) {
    const Matrix2<double> f{1, random.in(-6e-3, 6e-3), 0, 1};
    const J2State<double> before = law_trial(f, J2State<double>{});
    const Hourglass<double> m{random.in(-1.2e9, 1.2e9), random.in(-1.2e9, 1.2e9)};
    CoupledBending<double> coupled{m, fibre / (3 * mu), 3 * mu / fibre, random.in(1, 2), 1.0};
    const auto next = radial_return(before, f, 1.0, mu, 1 / mu, ludwik, coupled);
    ASSERT_EQ(next.residual, 0);
    ASSERT_GE(coupled.retained, 0);
    ASSERT_LE(coupled.retained, 1);
    coupled.stress = {coupled.retained * m.one, coupled.retained * m.two};
    const double joint = std::sqrt(1.5 * coupled.joint_norm(squared_norm(next.s)));
    if (next.eps == 0) {
      ASSERT_LE(joint, 240e6 * (1 + 1e-12));
    } else {
      ASSERT_NEAR(joint / ludwik.flow_stress(next.eps), 1, 2e-12);
      ++bent;
    }
  }
  EXPECT_GT(bent, 1000);
}

TEST(IteratedReturn, LanesGiveTheBitsOfTheScalar) {
  Random random(9);
  for (int i = 0; i < 500; ++i) {
    const double size = std::pow(10, random.in(-4, -1.5));
    Matrix2<Lane> f{1, 0, 0, 1};
    J2State<Lane> old{};
    for (int l = 0; l < lane_count; ++l) {
      f.xy[l] = size * random.in(-1, 1), f.xx[l] = 1 + size * random.in(-1, 1);
      old.eps[l] = l % 2 == 0 ? 0 : random.in(0, 0.3);
    }
    const RatedHardening law{ludwik, rate, 1e7};
    const auto lanes = law_step(f, old, law);
    for (int l = 0; l < lane_count; ++l) {
      const J2State<double> before{{}, {}, old.eps[l]};
      const auto one = law_step(Matrix2<double>{f.xx[l], f.xy[l], 0, 1}, before, law);
      ASSERT_EQ(bits(lanes.eps[l]), bits(one.eps));
      ASSERT_EQ(bits(lanes.s.xy[l]), bits(one.s.xy));
      ASSERT_EQ(bits(lanes.c.zz[l]), bits(one.c.zz));
    }
  }
}

TEST(IteratedReturn, SaysWhereThereIsNoStress) {
  // A curve that is no number just behind where flow begins.
  const TabulatedHardening gap{{0, 0.001, 0.002, 1},
                               {240e6, 241e6, std::numeric_limits<double>::quiet_NaN(), 300e6}};
  const auto next = law_step(Matrix2<double>{1, 0.02, 0, 1}, J2State<double>{{}, {}, 0.0}, gap);
  EXPECT_TRUE(std::isnan(next.residual));
  EXPECT_EQ(law_step(Matrix2<double>{1, 0.02, 0, 1}, J2State<double>{}, voce).residual, 0);
}

}  // namespace
}  // namespace pulvis::kernels
