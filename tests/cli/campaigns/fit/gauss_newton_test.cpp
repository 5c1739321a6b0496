// The search alone: known curves are found, ends of the range and forbidden points are kept to.
#include "cli/campaigns/fit/gauss_newton.hpp"

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

// One parameter is at its bound: the other has the value that is best there, not that of the minimum beyond the bound.
TEST(GaussNewton, FitsTheOthersWhileOneIsAtItsBound) {
  const Point truth{0.3, 0.4};
  const GaussNewton found = sought(GaussNewton({{0.1, 0, 0.15, 0.02}, {0.2, 0, 0.9, 0.02}}, 0.01,
                                               20, [](const Point&) { return true; }),
                                   [&](const Point& p) { return weakening(p, truth); });
  // (p1 - 0.4) e + (0.15 - 0.3) (1 - e) = 0 in the mean weighted with e = exp(-x/0.3)
  const Eigen::VectorXd e = weakening({0, 1}, {0, 0}), rest = weakening({1, 0}, {0, 0});
  EXPECT_EQ(found.state(), GaussNewton::State::converged);
  EXPECT_NEAR(found.best()[1], 0.4 + 0.15 * e.dot(rest) / e.squaredNorm(), 2e-4);
}

// A friction that rises: the best allowed values are equal, and the search moves along the border to them.
TEST(GaussNewton, FindsTheBestPointAtTheBorderOfWhatIsAllowed) {
  const Point truth{0.3, 0.2};
  const auto residuals = [&](const Point& p) { return weakening(p, truth); };
  for (const double step : {0.02, 0.005}) {
    const GaussNewton found = sought(GaussNewton({{0.15, 0, 0.5, 0.02}, {0.2, 0, 0.6, step}}, 0.01,
                                                 8, [](const Point& p) { return p[1] >= p[0]; }),
                                     residuals);
    EXPECT_EQ(found.state(), GaussNewton::State::converged);
    EXPECT_TRUE(found.is_at_limit());
    const double best = residuals({0, 0}).mean() * -1;
    EXPECT_NEAR(found.best()[0], best, 5e-4);
    EXPECT_NEAR(found.best()[1], best, 5e-4);
  }
}

// In three dimensions, at a border that is oblique to all axes.
TEST(GaussNewton, FindsTheBestPointAtAnObliquePlane) {
  const auto allowed = [](const Point& p) { return p[0] + 2 * p[1] + 3 * p[2] <= 1; };
  const GaussNewton found =
      sought(GaussNewton({{0, -5, 5, 0.01}, {0, -5, 5, 0.02}, {0, -5, 5, 0.04}}, 0.01, 20, allowed),
             [](const Point& p) {
               return Eigen::VectorXd(Eigen::Vector3d(p[0] - 1, p[1] - 2, p[2] - 3));
             });
  EXPECT_EQ(found.state(), GaussNewton::State::converged);
  EXPECT_TRUE(found.is_at_limit());
  const double away = 13.0 / 14;  // (1, 2, 3) less its distance to the plane along (1, 2, 3)
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_NEAR(found.best()[k], (1 - away) * static_cast<double>(k + 1), 1e-3);
}

// The border is a circle.
TEST(GaussNewton, FindsTheBestPointAtACurvedBorder) {
  const auto allowed = [](const Point& p) { return p[0] * p[0] + p[1] * p[1] <= 1; };
  const GaussNewton found = sought(
      GaussNewton({{0.1, -5, 5, 0.01}, {-0.3, -5, 5, 0.01}}, 0.01, 20, allowed),
      [](const Point& p) { return Eigen::VectorXd(Eigen::Vector2d(p[0] - 3, 2 * (p[1] - 4))); });
  EXPECT_EQ(found.state(), GaussNewton::State::converged);
  EXPECT_TRUE(found.is_at_limit());
  EXPECT_NEAR(std::hypot(found.best()[0], found.best()[1]), 1, 1e-3);
  // The slope of the misfit is normal to the circle.
  const double x = found.best()[0], y = found.best()[1];
  EXPECT_NEAR((x - 3) * y, 4 * (y - 4) * x, 0.02);
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

// The start and the neighbour beside it: the neighbour is better.
TEST(GaussNewton, TheBestPointMayBeANeighbour) {
  const GaussNewton found =
      sought(GaussNewton({{0.1, 0, 1, 0.1}}, 0.01, 1, [](const Point&) { return true; }),
             [](const Point& p) { return Eigen::VectorXd(Eigen::Vector2d(p[0] - 0.5, 0.3)); });
  EXPECT_EQ(found.state(), GaussNewton::State::gave_up);
  EXPECT_DOUBLE_EQ(found.best()[0], 0.2);
}

}  // namespace
}  // namespace pulvis
