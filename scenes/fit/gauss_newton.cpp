#include "scenes/fit/gauss_newton.hpp"

#include <algorithm>
#include <cmath>

#include "scenes/solve/least_squares.hpp"

namespace pulvis {

GaussNewton::GaussNewton(std::vector<FreeParameter> parameters, double tolerance, int max_rounds,
                         Allowed is_allowed)
    : parameters_(std::move(parameters)),
      tolerance_(tolerance),
      max_rounds_(max_rounds),
      is_allowed_(std::move(is_allowed)) {
  Point start;
  for (const FreeParameter& p : parameters_) start.push_back(p.start);
  ask(start);
}

bool GaussNewton::is_at_bound(std::size_t parameter) const {
  const FreeParameter& p = parameters_[parameter];
  const double near = tolerance_ * p.step;
  return best_[parameter] <= p.low + near || best_[parameter] >= p.high - near;
}

void GaussNewton::ask(const Point& point) {
  asks_ = {point};
  for (std::size_t k = 0; k < point.size(); ++k) {
    const FreeParameter& p = parameters_[k];
    Point beside = point;
    for (const double step : {p.step, -p.step, 0.25 * p.step, -0.25 * p.step}) {
      beside[k] = point[k] + step;
      if (beside[k] >= p.low && beside[k] <= p.high && is_allowed_(beside)) break;
      beside[k] = point[k];
    }
    if (beside[k] == point[k]) {  // no step is allowed on either side
      state_ = State::gave_up;
      return;
    }
    asks_.push_back(beside);
  }
}

void GaussNewton::tell(const std::vector<Eigen::VectorXd>& residuals) {
  ++rounds_;
  if (best_.empty() || residuals.front().squaredNorm() < residuals_.squaredNorm()) {
    best_ = asks_.front();
    residuals_ = residuals.front();
    jacobian_.resize(residuals_.size(), static_cast<Eigen::Index>(parameters_.size()));
    for (std::size_t k = 0; k < parameters_.size(); ++k)
      jacobian_.col(static_cast<Eigen::Index>(k)) =
          (residuals[k + 1] - residuals_) / (asks_[k + 1][k] - best_[k]);
    lambda_ = std::max(lambda_ / 10, 1e-9);
  } else {
    lambda_ = std::max(lambda_ * 10, 1e-2);
  }
  move();
}

void GaussNewton::move() {
  const Eigen::MatrixXd normal = jacobian_.transpose() * jacobian_;
  const Eigen::MatrixXd damped = normal + Eigen::MatrixXd(lambda_ * normal.diagonal().asDiagonal());
  const Eigen::VectorXd change =
      -shortest_least_squares(damped, jacobian_.transpose() * residuals_);
  Point next = best_;
  constexpr int max_halvings = 20;
  double share = 1;
  for (int halving = 0; halving < max_halvings; ++halving, share /= 2) {
    for (std::size_t k = 0; k < next.size(); ++k)
      next[k] = std::clamp(best_[k] + share * change[static_cast<Eigen::Index>(k)],
                           parameters_[k].low, parameters_[k].high);
    if (is_allowed_(next)) break;
    next = best_;
  }
  bool is_small = true;
  for (std::size_t k = 0; k < next.size(); ++k)
    is_small &= std::abs(next[k] - best_[k]) <= tolerance_ * parameters_[k].step;
  if (is_small)
    state_ = State::converged;
  else if (rounds_ >= max_rounds_)
    state_ = State::gave_up;
  else
    ask(next);
}

}  // namespace pulvis
