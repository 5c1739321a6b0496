// The search alone: known curves are found, ends of the range and forbidden points are kept to.
#include "scenes/fit/gauss_newton.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace pulvis {
namespace {

using Point = GaussNewton::Point;

// a + (b - a) exp(-x/0.3): the friction of a plate that weakens.
Eigen::VectorXd weakening(const Point& at, const Point& truth) {
  Eigen::VectorXd r(50);
  const auto curve = [](const Point& p, double x) {
    return p[0] + (p[1] - p[0]) * std::exp(-x / 0.3);
  };
  for (int i = 0; i < 50; ++i) r[i] = curve(at, 0.04 * i) - curve(truth, 0.04 * i);
  return r;
}

template <class Function>
GaussNewton sought(GaussNewton search, const Function& residuals) {
  while (search.state() == GaussNewton::State::going) {
    std::vector<Eigen::VectorXd> told;
    for (const Point& point : search.asks()) told.push_back(residuals(point));
    search.tell(told);
  }
  return search;
}

TEST(GaussNewton, FindsALinearCurveInThreeRounds) {
  const Point truth{0.185, 0.262};
  const GaussNewton found = sought(GaussNewton({{0.1, 0, 0.5, 0.02}, {0.2, 0, 0.6, 0.02}}, 0.01, 8,
                                               [](const Point&) { return true; }),
                                   [&](const Point& p) { return weakening(p, truth); });
  EXPECT_EQ(found.state(), GaussNewton::State::converged);
  EXPECT_LE(found.rounds(), 3);
  EXPECT_NEAR(found.best()[0], truth[0], 2e-4);
  EXPECT_NEAR(found.best()[1], truth[1], 2e-4);
}

TEST(GaussNewton, FindsACurvedValleyThoughFullStepsOvershoot) {
  const auto rosenbrock = [](const Point& p) {
    return Eigen::VectorXd(Eigen::Vector2d(10 * (p[1] - p[0] * p[0]), 1 - p[0]));
  };
  const GaussNewton found = sought(GaussNewton({{-1.2, -3, 3, 1e-3}, {1, -3, 3, 1e-3}}, 0.01, 100,
                                               [](const Point&) { return true; }),
                                   rosenbrock);
  EXPECT_EQ(found.state(), GaussNewton::State::converged);
  EXPECT_NEAR(found.best()[0], 1, 1e-3);
  EXPECT_NEAR(found.best()[1], 1, 2e-3);
}

TEST(GaussNewton, StopsAtTheEndOfTheRange) {
  const GaussNewton found = sought(GaussNewton({{0.1, 0, 0.15, 0.02}, {0.2, 0, 0.6, 0.02}}, 0.01,
                                               20, [](const Point&) { return true; }),
                                   [](const Point& p) {
                                     return weakening(p, {0.3, 0.4});
                                   });
  EXPECT_TRUE(found.is_at_bound(0));
  EXPECT_FALSE(found.is_at_bound(1));
  EXPECT_DOUBLE_EQ(found.best()[0], 0.15);
}

// A static coefficient below the dynamic one makes no scene: neither differences nor moves ask for one.
TEST(GaussNewton, AsksForNothingThatIsNotAllowed) {
  const auto allowed = [](const Point& p) { return p[1] >= p[0]; };
  const auto residuals = [&](const Point& p) {
    EXPECT_TRUE(allowed(p));
    return weakening(p, {0.2, 0.21});
  };
  const GaussNewton found =
      sought(GaussNewton({{0.3, 0, 0.6, 0.02}, {0.3, 0, 0.6, 0.02}}, 0.01, 30, allowed), residuals);
  EXPECT_NEAR(found.best()[0], 0.2, 2e-3);
  EXPECT_NEAR(found.best()[1], 0.21, 2e-3);
}

TEST(GaussNewton, GivesUpAfterItsRounds) {
  const GaussNewton found = sought(
      GaussNewton({{0.1, 0, 1, 0.1}}, 1e-9, 2, [](const Point&) { return true; }),
      [](const Point& p) { return Eigen::VectorXd(Eigen::Vector2d(std::exp(3 * p[0]) - 5, 0.3)); });
  EXPECT_EQ(found.state(), GaussNewton::State::gave_up);
  EXPECT_EQ(found.rounds(), 2);
}

}  // namespace
}  // namespace pulvis
