#include "scenes/solve/least_squares.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace pulvis {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// A line through four points: the normal equations by hand.
TEST(LeastSquares, OfALineAreThoseOfTheNormalEquations) {
  MatrixXd a(4, 2);
  a << 1, 0, 1, 1, 1, 2, 1, 3;
  const VectorXd b = (VectorXd(4) << 1, 3, 2, 5).finished();
  const VectorXd x = least_squares(a, b);
  EXPECT_NEAR(x[0], 1.1, 1e-14);
  EXPECT_NEAR(x[1], 1.1, 1e-14);
  EXPECT_EQ(rank_of(a), 2);
}

// Two equal columns share what one would take; Penrose's four conditions.
TEST(LeastSquares, OfAMatrixWithoutFullRankAreTheShortest) {
  MatrixXd a(3, 2);
  a << 1, 1, 2, 2, 3, 3;
  EXPECT_EQ(rank_of(a), 1);
  const VectorXd x = shortest_least_squares(a, (VectorXd(3) << 2, 4, 6).finished());
  EXPECT_NEAR(x[0], 1, 1e-14);
  EXPECT_NEAR(x[1], 1, 1e-14);
  const MatrixXd inverse = pseudo_inverse(a);
  EXPECT_TRUE((a * inverse * a).isApprox(a, 1e-13));
  EXPECT_TRUE((inverse * a * inverse).isApprox(inverse, 1e-13));
  EXPECT_TRUE((a * inverse).isApprox((a * inverse).transpose(), 1e-13));
  EXPECT_TRUE((inverse * a).isApprox((inverse * a).transpose(), 1e-13));
}

// Rosenbrock (1960) from his start: a curved valley, least at (1, 1).
TEST(LeastSquares, TheSearchFollowsRosenbrocksValley) {
  int asked = 0;
  const Residuals rosenbrock = [&](const VectorXd& x, VectorXd& residuals) {
    ++asked;
    residuals[0] = 10 * (x[1] - x[0] * x[0]);
    residuals[1] = 1 - x[0];
  };
  VectorXd x = (VectorXd(2) << -1.2, 1).finished();
  levenberg_marquardt(rosenbrock, 2, {.evaluations = 1000, .tolerance = 1e-12}, x);
  EXPECT_NEAR(x[0], 1, 1e-9);
  EXPECT_NEAR(x[1], 1, 1e-9);
  EXPECT_LT(asked, 300);

  x << -1.2, 1;
  levenberg_marquardt(rosenbrock, 2, {.evaluations = 5, .tolerance = 1e-12}, x);
  EXPECT_GT(std::abs(x[0] - 1), 0.1);  // given up
}

}  // namespace
}  // namespace pulvis
