#include "cli/campaigns/fit/gauss_newton.hpp"

#include <algorithm>

#include "cli/campaigns/fit/limited_step.hpp"

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

// Whether the round has a point that is better than all before. The slopes of the round are those between its points, for
// whichever of them is the best.
bool GaussNewton::take_best(const std::vector<Eigen::VectorXd>& residuals) {
  const auto best = std::ranges::min_element(residuals, {}, &Eigen::VectorXd::squaredNorm);
  if (!best_.empty() && !(best->squaredNorm() < residuals_.squaredNorm())) return false;
  best_ = asks_[static_cast<std::size_t>(best - residuals.begin())];
  residuals_ = *best;
  jacobian_.resize(residuals_.size(), static_cast<Eigen::Index>(parameters_.size()));
  inside_ = asks_.front();
  for (std::size_t k = 0; k < parameters_.size(); ++k) {
    const double change = asks_[k + 1][k] - asks_.front()[k];
    jacobian_.col(static_cast<Eigen::Index>(k)) = (residuals[k + 1] - residuals.front()) / change;
    inside_[k] += change / static_cast<double>(asks_.size());
  }
  if (!is_allowed_(inside_)) inside_ = best_;
  return true;
}

void GaussNewton::tell(const std::vector<Eigen::VectorXd>& residuals) {
  ++rounds_;
  lambda_ = take_best(residuals) ? std::max(lambda_ / 10, 1e-9) : std::max(lambda_ * 10, 1e-2);
  move();
}

// From the best point, by multiples of the steps.
GaussNewton::Point GaussNewton::moved(const Eigen::VectorXd& steps) const {
  Point to = best_;
  for (std::size_t k = 0; k < to.size(); ++k)
    to[k] += steps[static_cast<Eigen::Index>(k)] * parameters_[k].step;
  return to;
}

// What is at a bound but for rounding is exactly there.
GaussNewton::Point GaussNewton::within_bounds(Point point) const {
  constexpr double rounding = 1e-9;
  for (std::size_t k = 0; k < point.size(); ++k) {
    const FreeParameter& p = parameters_[k];
    if (point[k] < p.low + rounding * p.step) point[k] = p.low;
    if (point[k] > p.high - rounding * p.step) point[k] = p.high;
  }
  return point;
}

void GaussNewton::move() {
  const auto count = static_cast<Eigen::Index>(parameters_.size());
  Eigen::MatrixXd slopes = jacobian_;  // per step
  Eigen::VectorXd inside(count);
  std::vector<HalfSpace> bounds;
  for (Eigen::Index k = 0; k < count; ++k) {
    const FreeParameter& p = parameters_[static_cast<std::size_t>(k)];
    const double at = best_[static_cast<std::size_t>(k)];
    slopes.col(k) *= p.step;
    inside[k] = (inside_[static_cast<std::size_t>(k)] - at) / p.step;
    bounds.push_back({Eigen::VectorXd::Unit(count, k), (p.high - at) / p.step});
    bounds.push_back({-Eigen::VectorXd::Unit(count, k), (at - p.low) / p.step});
  }
  const Eigen::MatrixXd normal = slopes.transpose() * slopes;
  const QuadraticModel model{normal + Eigen::MatrixXd(lambda_ * normal.diagonal().asDiagonal()),
                             slopes.transpose() * residuals_};
  const LimitedStep step =
      limited_step(model, bounds,
                   {[this](const Eigen::VectorXd& steps) { return is_allowed_(moved(steps)); },
                    inside, 0.1 * tolerance_});
  is_at_limit_ = step.at_border;
  if (step.to.cwiseAbs().maxCoeff() <= tolerance_)
    state_ = step.is_best ? State::converged : State::gave_up;
  else if (rounds_ >= max_rounds_)
    state_ = State::gave_up;
  else
    ask(within_bounds(moved(step.to)));
}

}  // namespace pulvis
