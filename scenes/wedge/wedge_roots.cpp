#include "scenes/wedge/wedge_roots.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "engine/portable_math.hpp"
#include "scenes/solve/lab_statistics.hpp"
#include "scenes/solve/least_squares.hpp"

namespace pulvis::wedge {
namespace {

constexpr double deviations = 3;        // standard ones, between the two fits
constexpr double probability = 0.9973;  // of three of them
constexpr double rounding = 1e-7;       // of the half-widths: differences that are not scatter
constexpr double unfit = 1e10;          // residual of what locks the tip

// All loops with one friction coefficient on one side of the double root.
class JointFit {
 public:
  JointFit(const std::vector<Loop>& loops, const Known& known, const Calibration& start,
           double meeting)
      : loops_(loops), known_(known), meeting_(meeting), start_(start) {
    side_ = start.friction.value < meeting ? -1 : 1;
    for (const Facet& facet : start.facets) {
      at_.emplace(facet.slope, static_cast<Eigen::Index>(at_.size()));
      if (facet.loads > 1) is_over_loads_ = true;
      if (!facet.friction) has_flat_ = true;
      adhesion_ += facet.adhesion ? facet.adhesion->value : 0;
    }
    const auto n = static_cast<double>(loops.size());
    known_errors_ = true;
    double squares = 0;
    for (const Loop& loop : loops) {
      load_ += std::abs(loop.load) / n;
      squares += loop.half_width * loop.half_width / n;
      known_errors_ = known_errors_ && loop.half_width_error.value_or(0) > 0 &&
                      loop.offset_error.value_or(0) > 0;
    }
    volts_ = std::sqrt(squares);
    x_ = Eigen::VectorXd::Zero(parameters());
    x_[0] = portable::log(std::max(std::abs(portable::log(start.friction.value / meeting)), 1e-6));
    if (is_over_loads_) x_[2] = adhesion_ / static_cast<double>(start.facets.size()) / load_;
    minimise();
  }

  bool errors_known() const { return known_errors_; }
  double squares() const { return squares_; }
  Eigen::Index freedom() const { return count() - parameters(); }

 private:
  bool slopes_move() const { return known_errors_ && known_.slope_error > 0; }
  Eigen::Index moving() const { return slopes_move() ? static_cast<Eigen::Index>(at_.size()) : 0; }
  // Friction, sensitivity; adhesion and offset of the detector; crosstalk; slopes.
  Eigen::Index parameters() const {
    return 2 + (is_over_loads_ ? 2 : 0) + (has_flat_ ? 1 : 0) + moving();
  }
  Eigen::Index count() const { return 2 * static_cast<Eigen::Index>(loops_.size()) + moving(); }

  void residuals(const Eigen::VectorXd& x, Eigen::VectorXd& r) const {
    const double mu = meeting_ * portable::exp(side_ * portable::exp(x[0]));
    const double sensitivity = start_.sensitivity.value * portable::exp(x[1]);
    Eigen::Index k = 2;
    const double a = is_over_loads_ ? x[k++] * load_ : known_.adhesion;
    const double zero = is_over_loads_ ? x[k++] * volts_ : 0;
    const double by_load = has_flat_ ? x[k++] * volts_ / load_ : 0;
    Eigen::Index row = 0;
    for (const Loop& loop : loops_) {
      double slope = loop.slope;
      if (slopes_move()) slope += known_.slope_error * x[k + at_.at(loop.slope)];
      const double s = portable::sin(slope), c = portable::cos(slope);
      const double offset = ((1 + mu * mu) * loop.load * s * c + mu * mu * a * s) /
                            ((c * c - mu * mu * s * s) * sensitivity);
      const double width = half_width(loop.load, a, mu, slope) / sensitivity;
      const double width_error = known_errors_ ? *loop.half_width_error : volts_;
      const double offset_error = known_errors_ ? *loop.offset_error : volts_;
      const bool moves = !locks(mu, slope) && c > 0;
      r[row++] = moves ? (width - loop.half_width) / width_error : unfit;
      r[row++] = moves ? (offset + by_load * loop.load + zero - loop.offset) / offset_error : unfit;
    }
    for (; row < r.size(); ++row) r[row] = x[k++];
  }

  void minimise() {
    const auto write = [this](const Eigen::VectorXd& x, Eigen::VectorXd& r) { residuals(x, r); };
    if (count() >= parameters()) levenberg_marquardt(write, count(), {10000, 1e-12}, x_);
    Eigen::VectorXd r(count());
    residuals(x_, r);
    squares_ = r.squaredNorm();
  }

  const std::vector<Loop>& loops_;
  const Known& known_;
  double meeting_;
  const Calibration& start_;
  double side_ = 0;
  std::map<double, Eigen::Index> at_;  // by slope
  bool is_over_loads_ = false, has_flat_ = false, known_errors_ = false;
  double adhesion_ = 0, load_ = 0, volts_ = 0;  // N, N, V: units of the parameters
  Eigen::VectorXd x_;
  double squares_ = 0;
};

// Of the difference between the two sums of squares, for a decision.
double needed(const JointFit& better) {
  const auto freedom = static_cast<double>(better.freedom());
  if (better.errors_known())
    return deviations * deviations * std::max(1.0, freedom > 0 ? better.squares() / freedom : 0);
  if (freedom < 1) return std::numeric_limits<double>::infinity();
  const double t = lab::student_quantile(probability, static_cast<int>(freedom));
  return t * t * std::max(better.squares() / freedom, rounding * rounding);
}

}  // namespace

std::optional<Root> agreeing_root(const std::vector<Loop>& loops, const Known& known,
                                  const Calibration& lower, const Calibration& upper) {
  const double meeting = std::sqrt(lower.friction.value * upper.friction.value);
  const JointFit below(loops, known, lower, meeting), above(loops, known, upper, meeting);
  const bool is_above = above.squares() < below.squares();
  const double difference = std::abs(above.squares() - below.squares());
  if (!(difference > needed(is_above ? above : below))) return std::nullopt;
  return is_above ? Root::upper : Root::lower;
}

}  // namespace pulvis::wedge
