// The law of a probe's point: its derivatives, and the balance it leads to.
#include <gtest/gtest.h>

#include "systems/lever/probe_contact_kernel.hpp"

namespace pulvis::kernels {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using State = ProbeEquation::State;

// Over a round surface: gap, normal and its turn by the place.
ProbePlace over_a_ball(const Vector3d& x) {
  constexpr double radius = 2;
  const double r = x.norm();
  const Vector3d n = x / r;
  return {r - radius, n, (Matrix3d::Identity() - n * n.transpose()) / r,
          x - Vector3d(0.1, -0.05, 2.01), Vector3d(0.3, 0.1, 0)};
}

struct Case {
  State state;
  Vector3d force, place;
};

class ProbeLawOf : public testing::TestWithParam<Case> {};

TEST_P(ProbeLawOf, HasTheDerivativesOfItsEquations) {
  const ProbeLaw law{100, 80, 0.3, 0.5, 0.2};
  const auto [state, f, x] = GetParam();
  constexpr double rho = 3, rho_t = 2, h = 1e-6;
  const auto r = probe_equation(law, over_a_ball(x), f, rho, rho_t);
  ASSERT_EQ(r.state, state);
  for (int k = 0; k < 3; ++k) {
    const Vector3d step = h * Vector3d::Unit(k);
    const Vector3d by_force = (probe_equation(law, over_a_ball(x), f + step, rho, rho_t).residual -
                               probe_equation(law, over_a_ball(x), f - step, rho, rho_t).residual) /
                              (2 * h);
    const Vector3d by_place = (probe_equation(law, over_a_ball(x + step), f, rho, rho_t).residual -
                               probe_equation(law, over_a_ball(x - step), f, rho, rho_t).residual) /
                              (2 * h);
    EXPECT_LT((r.by_force.col(k) - by_force).norm(), 1e-7) << k;
    EXPECT_LT((r.by_place.col(k) - by_place).norm(), 1e-7) << k;
  }
}

INSTANTIATE_TEST_SUITE_P(States, ProbeLawOf,
                         testing::Values(Case{State::apart, {0.1, -0.2, 0.1}, {0.2, 0.1, 2.9}},
                                         Case{State::sticks, {0.1, -0.05, 2}, {0.1, -0.04, 1.98}},
                                         Case{State::slides, {0.5, -0.3, 1}, {0.4, 0.2, 1.9}},
                                         Case{State::slides, {0.5, -0.3, 1}, {0.3, 0.2, 2.05}}));

}  // namespace
}  // namespace pulvis::kernels
