// Fits a few parameters of a function that is expensive to evaluate by damped Gauss-Newton iterations.
//
// Source   Levenberg (1944), Marquardt (1963): (J'J + lambda diag(J'J)) d = -J' r; lambda falls tenfold with every round
//          that improves the fit and rises tenfold with every one that does not
// Rounds   a point plus one neighbour per parameter, which give J by differences: all points of a round can run in parallel
// Limits   bounds of the parameters and points that are not allowed: limited_step.hpp
// End      when the next move is a small fraction of every parameter's step
#pragma once

#include <Eigen/Dense>
#include <functional>
#include <vector>

namespace pulvis {

struct FreeParameter {
  double start = 0, low = 0, high = 0;
  double step = 0;  // for the differences
};

class GaussNewton {
 public:
  using Point = std::vector<double>;
  using Allowed = std::function<bool(const Point&)>;
  enum class State { going, converged, gave_up };

  // `tolerance`: fraction of a step. Points outside the bounds are never requested; `start` always is.
  GaussNewton(std::vector<FreeParameter> parameters, double tolerance, int max_rounds,
              Allowed is_allowed);

  State state() const { return state_; }
  int rounds() const { return rounds_; }
  // The points of this round: the current one, then one neighbour for each parameter.
  const std::vector<Point>& asks() const { return asks_; }
  // Residuals of each of them, all of the same length.
  void tell(const std::vector<Eigen::VectorXd>& residuals);

  // The best of all points so far, neighbours included, once residuals have been passed in.
  const Point& best() const { return best_; }
  const Eigen::VectorXd& residuals() const { return residuals_; }
  const Eigen::MatrixXd& jacobian() const { return jacobian_; }
  bool is_at_bound(std::size_t parameter) const;
  // Points that are not allowed keep the search from a better fit.
  bool is_at_limit() const { return is_at_limit_; }

 private:
  void ask(const Point& point);
  bool take_best(const std::vector<Eigen::VectorXd>& residuals);
  Point moved(const Eigen::VectorXd& steps) const;
  Point within_bounds(Point point) const;
  void move();

  std::vector<FreeParameter> parameters_;
  double tolerance_;
  int max_rounds_, rounds_ = 0;
  Allowed is_allowed_;
  State state_ = State::going;
  bool is_at_limit_ = false;
  std::vector<Point> asks_;
  double lambda_ = 1e-3;
  Point best_, inside_;  // middle of the round of the best point
  Eigen::VectorXd residuals_;
  Eigen::MatrixXd jacobian_;
};

}  // namespace pulvis
