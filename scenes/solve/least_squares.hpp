// Least squares: Eigen's decompositions and search, compiled once for all users.
#pragma once

#include <Eigen/Core>
#include <functional>

namespace pulvis {

// x that minimises |a x - b|, by QR with column pivoting; a has as many columns as x and full rank.
Eigen::VectorXd least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);
Eigen::Index rank_of(const Eigen::MatrixXd& a);

// For a matrix of any rank, by its complete orthogonal decomposition: the minimum-norm x that minimises |a x - b|, and
// the Moore-Penrose inverse.
Eigen::VectorXd shortest_least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);
Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& a);

// Correlation of neighbouring residuals, between 0 and 0.99. n residuals with the correlation r count as n (1 - r)/(1 + r)
// independent ones.
double neighbour_correlation(const Eigen::VectorXd& residuals);

// Writes as many residuals as the vector has.
using Residuals = std::function<void(const Eigen::VectorXd& x, Eigen::VectorXd& residuals)>;

struct SearchLimits {
  int evaluations;            // of the residuals, at most
  double tolerance = 1.5e-8;  // relative, of x and of the sum of squares; square root of rounding
  double difference = 0;      // relative error of the residuals, for finite-difference steps
};

// Moves x to a local minimum of the sum of `count` squares, slopes by differences (Levenberg-Marquardt; More 1978).
void levenberg_marquardt(const Residuals& residuals, Eigen::Index count, const SearchLimits& limits,
                         Eigen::VectorXd& x);

}  // namespace pulvis
