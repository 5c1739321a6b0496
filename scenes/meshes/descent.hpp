// Minimises a mesh quality measure; folded elements are unfolded where possible.
//
// Source: Garanzha et al., Foldover-free maps in 50 lines of code, ACM Trans. Graph. 40 (2021) 102; minimised by L-BFGS
// (Nocedal & Wright, 7.4).
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <deque>
#include <vector>

#include "engine/portable_math.hpp"

namespace pulvis {

// Descent directions from the last steps and the gradient changes over them.
class Lbfgs {
 public:
  Eigen::VectorXd direction(const Eigen::VectorXd& gradient) const {
    Eigen::VectorXd q = -gradient;
    std::vector<double> share(pairs_.size());
    for (std::size_t i = pairs_.size(); i-- > 0;) {
      share[i] = pairs_[i].step.dot(q) / pairs_[i].product;
      q -= share[i] * pairs_[i].change;
    }
    if (!pairs_.empty()) q *= pairs_.back().product / pairs_.back().change.squaredNorm();
    for (std::size_t i = 0; i < pairs_.size(); ++i)
      q += (share[i] - pairs_[i].change.dot(q) / pairs_[i].product) * pairs_[i].step;
    return q;
  }
  void learn(const Eigen::VectorXd& step, const Eigen::VectorXd& change) {
    const double product = step.dot(change);
    if (product <= 0) return;
    pairs_.push_back({step, change, product});
    if (pairs_.size() > memory) pairs_.pop_front();
  }
  void forget() { pairs_.clear(); }

 private:
  static constexpr std::size_t memory = 8;  // pairs
  struct Pair {
    Eigen::VectorXd step, change;
    double product;
  };
  std::deque<Pair> pairs_;
};

struct Descent {
  Eigen::VectorXd x, gradient;
  double value;
};

namespace descent {

inline constexpr double converged = 1e-9;  // relative change of the mean over an iteration
inline constexpr int min_iterations_between_bounds = 30;

// No regularisation where all corners are wide open; at a flat corner (of the core, in the middle of a
// straight side) the measure is too steep to move away from, so 1/determinant is softened there.
inline constexpr double open_corner = 1e-3, min_bound = 1e-6;
inline double bound_for(double min_determinant) {
  return min_determinant > open_corner ? min_bound : portable::hypot(0.1, 0.2 * min_determinant);
}

// Backtracks along the direction until the value is low enough (Armijo); false: no such step. No node moves by
// more than `most`, as the quality measures moves. `round_off` is the relative error of the value, below which it does not judge a step.
template <class Quality>
bool advance(const Quality& quality, double bound, const Eigen::VectorXd& direction, double most,
             Descent& state, double round_off = 0) {
  const double slope = direction.dot(state.gradient);
  if (!(slope < 0)) return false;
  const double largest = quality.longest_move(direction);
  Descent next = state;
  for (double share = std::min(1.0, most / largest); share * largest > 1e-12; share *= 0.5) {
    next.x = state.x + share * direction;
    next.value = quality.value(next.x, bound, next.gradient);
    const double highest = state.value + 1e-4 * share * slope + round_off * state.value;
    if (!(next.value <= highest)) continue;
    state = std::move(next);
    return true;
  }
  return false;
}

}  // namespace descent

// Quality has start(), longest_move(direction), min_determinant(x) and value(x, bound, gradient), where `bound` regularises
// 1/determinant.
template <class Quality>
Descent descend(const Quality& quality, int max_iterations) {
  using namespace descent;
  Descent state{quality.start(), {}, 0};
  double bound = bound_for(quality.min_determinant(state.x));
  state.value = quality.value(state.x, bound, state.gradient);
  constexpr double most = 0.3;
  Lbfgs memory_of;
  for (int i = 1; i <= max_iterations; ++i) {
    const Descent before = state;
    if (!advance(quality, bound, memory_of.direction(state.gradient), most, state)) break;
    memory_of.learn(state.x - before.x, state.gradient - before.gradient);
    const bool still = before.value - state.value < converged * state.value;
    const bool folded = bound > min_bound;
    if (still && !folded) break;
    if (!folded || !(still || i % min_iterations_between_bounds == 0)) continue;
    const double next = bound_for(quality.min_determinant(state.x));
    if (still && next == bound) break;  // it cannot be unfolded
    bound = next;
    state.value = quality.value(state.x, bound, state.gradient);
    memory_of.forget();
  }
  return state;
}

}  // namespace pulvis
