#include "scenes/solve/least_squares.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <unsupported/Eigen/LevenbergMarquardt>
#include <unsupported/Eigen/NumericalDiff>

namespace pulvis {
namespace {

struct Problem : Eigen::DenseFunctor<double> {
  const Residuals& residuals;
  Problem(const Residuals& of, Eigen::Index parameters, Eigen::Index count)
      : DenseFunctor(static_cast<int>(parameters), static_cast<int>(count)), residuals(of) {}
  int operator()(const Eigen::VectorXd& x, Eigen::VectorXd& found) const {
    residuals(x, found);
    return 0;
  }
};

}  // namespace

Eigen::VectorXd least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  return a.colPivHouseholderQr().solve(b);
}
Eigen::Index rank_of(const Eigen::MatrixXd& a) { return a.colPivHouseholderQr().rank(); }

Eigen::VectorXd shortest_least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  return a.completeOrthogonalDecomposition().solve(b);
}
Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& a) {
  return a.completeOrthogonalDecomposition().pseudoInverse();
}

double neighbour_correlation(const Eigen::VectorXd& residuals) {
  const Eigen::Index n = residuals.size();
  const double squares = residuals.squaredNorm();
  if (!(squares > 0)) return 0;
  return std::clamp(residuals.head(n - 1).dot(residuals.tail(n - 1)) / squares, 0.0, 0.99);
}

void levenberg_marquardt(const Residuals& residuals, Eigen::Index count, const SearchLimits& limits,
                         Eigen::VectorXd& x) {
  using Sloped = Eigen::NumericalDiff<Problem>;
  Sloped sloped(Problem(residuals, x.size(), count), limits.difference);
  Eigen::LevenbergMarquardt<Sloped> search(sloped);
  search.setMaxfev(limits.evaluations);
  search.setXtol(limits.tolerance);
  search.setFtol(limits.tolerance);
  search.minimize(x);
}

}  // namespace pulvis
