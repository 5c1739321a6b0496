// Least squares: Eigen's decompositions and search, compiled once for all who use them.
#pragma once

#include <Eigen/Core>
#include <functional>

namespace pulvis {

// x of least |a x - b|, by QR with column pivots; a has as many columns as x and full rank.
Eigen::VectorXd least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);
Eigen::Index rank_of(const Eigen::MatrixXd& a);

// Of a matrix of any rank, by its complete orthogonal decomposition: the shortest x of least |a x - b|, and the
// Moore-Penrose inverse.
Eigen::VectorXd shortest_least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);
Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& a);

// Writes as many residuals as the vector has.
using Residuals = std::function<void(const Eigen::VectorXd& x, Eigen::VectorXd& residuals)>;

struct SearchLimits {
  int evaluations;            // of the residuals, at most
  double tolerance = 1.5e-8;  // relative, of x and of the sum of squares; the root of rounding
  double difference = 0;      // relative error of the residuals, for the steps of the slopes
};

// Takes x to a least sum of squares of `count` residuals near it, with slopes by differences (Levenberg-Marquardt; More 1978).
void levenberg_marquardt(const Residuals& residuals, Eigen::Index count, const SearchLimits& limits,
                         Eigen::VectorXd& x);

}  // namespace pulvis
