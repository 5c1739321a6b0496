#include "scenes/meshes/smooth_mesh.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>

#include "engine/portable_math.hpp"

namespace pulvis {
namespace {

constexpr std::size_t memory = 8;   // pairs of L-BFGS
constexpr double converged = 1e-9;  // relative change of the mean over an iteration
constexpr int min_iterations_between_bounds = 30;

class Quality {
 public:
  Quality(const std::vector<Point>& nodes, const std::vector<Quad>& quads, std::size_t fixed,
          double size_share)
      : quads_(quads),
        size_share_(size_share),
        fixed_(2 * static_cast<Eigen::Index>(fixed)),
        x_(2 * static_cast<Eigen::Index>(nodes.size())) {
    for (std::size_t i = 0; i < nodes.size(); ++i)
      for (std::size_t k = 0; k < 2; ++k) x_[static_cast<Eigen::Index>(2 * i + k)] = nodes[i][k];
    double area = 0;
    for (const Quad& quad : quads)
      for (std::size_t k = 0; k < 4; ++k) area += 0.25 * determinant(x_, quad, k);
    scale_ = std::sqrt(static_cast<double>(quads.size()) / area);
    x_ *= scale_;
  }

  const Eigen::VectorXd& start() const { return x_; }
  double scale() const { return scale_; }

  double min_determinant(const Eigen::VectorXd& x) const {
    double minimum = std::numeric_limits<double>::max();
    for (const Quad& quad : quads_)
      for (std::size_t k = 0; k < 4; ++k) minimum = std::min(minimum, determinant(x, quad, k));
    return minimum;
  }

  // The mean and its gradient; `bound` regularises 1/determinant (0: folded elements are infinitely bad).
  double value(const Eigen::VectorXd& x, double bound, Eigen::VectorXd& gradient) const {
    gradient.setZero(x.size());
    double sum = 0;
    for (const Quad& quad : quads_)
      for (std::size_t k = 0; k < 4; ++k) sum += corner(x, quad, k, bound, gradient);
    const double share = 1 / (4.0 * static_cast<double>(quads_.size()));
    gradient *= share;
    gradient.head(fixed_).setZero();
    return share * sum;
  }

 private:
  static Eigen::Vector2d at(const Eigen::VectorXd& x, const Quad& quad, std::size_t k) {
    return x.segment<2>(2 * quad[k % 4].value);
  }
  static double determinant(const Eigen::VectorXd& x, const Quad& quad, std::size_t k) {
    const Eigen::Vector2d a = at(x, quad, k + 1) - at(x, quad, k);
    const Eigen::Vector2d b = at(x, quad, k + 3) - at(x, quad, k);
    return a.x() * b.y() - a.y() * b.x();
  }

  double corner(const Eigen::VectorXd& x, const Quad& quad, std::size_t k, double bound,
                Eigen::VectorXd& gradient) const {
    const Eigen::Vector2d a = at(x, quad, k + 1) - at(x, quad, k);
    const Eigen::Vector2d b = at(x, quad, k + 3) - at(x, quad, k);
    const double d = a.x() * b.y() - a.y() * b.x(), root = portable::hypot(bound, d);
    const double chi = 0.5 * (d + root);
    const double f =
        ((1 - size_share_) * (a.squaredNorm() + b.squaredNorm()) + size_share_ * (d * d + 1)) / chi;
    const double by_d = (2 * size_share_ * d - f * 0.5 * (1 + d / root)) / chi;
    const double by_a = 2 * (1 - size_share_) / chi;
    const Eigen::Vector2d to_a = by_a * a + by_d * Eigen::Vector2d(b.y(), -b.x());
    const Eigen::Vector2d to_b = by_a * b + by_d * Eigen::Vector2d(-a.y(), a.x());
    gradient.segment<2>(2 * quad[(k + 1) % 4].value) += to_a;
    gradient.segment<2>(2 * quad[(k + 3) % 4].value) += to_b;
    gradient.segment<2>(2 * quad[k].value) -= to_a + to_b;
    return f;
  }

  const std::vector<Quad>& quads_;
  double size_share_;
  Eigen::Index fixed_;
  Eigen::VectorXd x_;
  double scale_ = 1;
};

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
  struct Pair {
    Eigen::VectorXd step, change;
    double product;
  };
  std::deque<Pair> pairs_;
};

// Nothing to regularise where all corners are well open; at a flat corner (the core's, in the middle of a
// straight side) the measure is a wall too steep to leave, so that 1/determinant is made gentle there.
constexpr double open_corner = 1e-3, min_bound = 1e-6;
double bound_for(double min_determinant) {
  return min_determinant > open_corner ? min_bound : portable::hypot(0.1, 0.2 * min_determinant);
}

struct State {
  Eigen::VectorXd x, gradient;
  double value;
};

// Along the direction to where the value is low enough (Armijo); false: nowhere.
bool advance(const Quality& quality, double bound, const Eigen::VectorXd& direction, State& state) {
  const double slope = direction.dot(state.gradient);
  if (!(slope < 0)) return false;
  const double largest = direction.cwiseAbs().maxCoeff();
  State next = state;
  for (double share = std::min(1.0, 0.3 / largest); share * largest > 1e-12; share *= 0.5) {
    next.x = state.x + share * direction;
    next.value = quality.value(next.x, bound, next.gradient);
    if (!(next.value <= state.value + 1e-4 * share * slope)) continue;
    state = std::move(next);
    return true;
  }
  return false;
}

}  // namespace

double smooth_mesh(std::vector<Point>& nodes, const std::vector<Quad>& quads, std::size_t fixed,
                   double size_share, int max_iterations) {
  const Quality quality(nodes, quads, fixed, size_share);
  State state{quality.start(), {}, 0};
  double bound = bound_for(quality.min_determinant(state.x));
  state.value = quality.value(state.x, bound, state.gradient);
  Lbfgs memory_of;
  for (int i = 1; i <= max_iterations; ++i) {
    const State before = state;
    if (!advance(quality, bound, memory_of.direction(state.gradient), state)) break;
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
  for (std::size_t i = fixed; i < nodes.size(); ++i)
    for (std::size_t k = 0; k < 2; ++k)
      nodes[i][k] = state.x[static_cast<Eigen::Index>(2 * i + k)] / quality.scale();
  return state.value;
}

}  // namespace pulvis
