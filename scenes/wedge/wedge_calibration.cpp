#include "scenes/wedge/wedge_calibration.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "engine/portable_math.hpp"
#include "scenes/wedge/wedge_facet.hpp"
#include "scenes/wedge/wedge_readings.hpp"
#include "scenes/wedge/wedge_roots.hpp"

namespace pulvis::wedge {
namespace {

constexpr double flat = 1e-6;  // rad: such a slope gives no information
// Relative: an offset of the detector as large as the crosstalk is then subtracted to this accuracy.
constexpr double same_load = 0.01;

// With several loads on the flat facet its line separates crosstalk from the offset of the detector. With one load
// only their sum is known, and only at that load.
Level level_for(const Reading& flat_one, const Reading& inclined) {
  const Fit& line = flat_one.offset;
  if (!flat_one.is_single()) {
    const double slope_error = line.slope.error.value_or(0);
    const bool known = line.slope.error.has_value();
    if (!inclined.is_single()) return {line.slope.value, {slope_error, 0}, known};
    const double load = inclined.load;
    return {line.at(load) / load,
            {slope_error * (load - line.load) / load, line.middle.error.value_or(0) / load},
            known};
  }
  if (inclined.is_single() &&
      std::abs(inclined.load - flat_one.load) > same_load * std::abs(flat_one.load))
    throw std::runtime_error(fmt::format(
        "the flat facet was measured at {:.4g} nN only and the slope of {:g} deg at {:.4g} nN "
        "only, where an offset of the detector cannot be told from the crosstalk of the load, "
        "allowed: the same load, or several loads on one of them",
        flat_one.load * 1e9, inclined.facet.slope * 180 / std::numbers::pi, inclined.load * 1e9));
  const Value& offset = flat_one.facet.offset;
  return {offset.value, {offset.error.value_or(0), 0}, offset.error.has_value()};
}

// At one load Delta holds crosstalk and offset in the same proportion on all facets.
Signals at_level_load(const Reading& inclined, double load, const Level& level) {
  const Fit& line = inclined.offset;
  Signals signals{inclined.facet.half_width,
                  {line.at(load) / load - level.by_load, {}},
                  *inclined.facet.adhesion,
                  inclined.facet.slope,
                  true};
  if (line.slope.error)
    signals.offset.error =
        portable::hypot(*line.middle.error / load, *line.slope.error * (load - line.load) / load);
  signals.adhesion.value /= load;
  // Its correlation with the half-width hardly matters: adhesion enters Delta with mu^2 only.
  if (signals.adhesion.error) *signals.adhesion.error /= load;
  return signals;
}

Value with_common(const Estimate& e) {
  if (!e.own.error) return e.own;
  if (!e.errors_known) return {e.own.value, {}};
  return {e.own.value, portable::hypot(*e.own.error, e.common.norm())};
}

// Mean of estimates with correlated errors (Aitken 1936); without errors a plain mean and its scatter.
struct MeanOfFacets {
  Value mean;
  std::vector<double> weights;  // their sum is 1
  double disagreement = 0;      // Birge ratio squared; only for estimates with errors
};

MeanOfFacets mean_of(const std::vector<Estimate>& estimates) {
  const auto n = static_cast<Eigen::Index>(estimates.size());
  Eigen::VectorXd value(n);
  Eigen::MatrixXd common(n, 3), covariance = Eigen::MatrixXd::Zero(n, n);
  bool weighted = true;
  for (Eigen::Index i = 0; i < n; ++i) {
    const Estimate& e = estimates[static_cast<std::size_t>(i)];
    value[i] = e.own.value;
    common.row(i) = e.common.transpose();
    weighted = weighted && e.errors_known && e.own.error && *e.own.error > 0;
    covariance(i, i) = e.own.error ? *e.own.error * *e.own.error : 0;
  }
  if (weighted)
    covariance += common * common.transpose();
  else
    covariance.setIdentity();
  // Scaled by the values: their squares would give matrix entries of about 1e-20.
  const double unit = value.cwiseAbs().maxCoeff();
  const auto factors = Eigen::MatrixXd(covariance / (weighted ? unit * unit : 1)).ldlt();
  const Eigen::VectorXd weight = factors.solve(Eigen::VectorXd::Ones(n));
  const double mean = weight.dot(value) / weight.sum();
  const Eigen::VectorXd rest = (value.array() - mean).matrix() / (weighted ? unit : 1);
  const double freedom = std::max(1.0, static_cast<double>(n - 1));
  const double disagreement = rest.dot(factors.solve(rest)) / freedom;
  MeanOfFacets all{{mean, {}}, {}, weighted ? disagreement : 0};
  for (const double w : weight) all.weights.push_back(w / weight.sum());
  if (weighted)
    all.mean.error = unit * std::sqrt(std::max(1.0, disagreement) / weight.sum());
  else if (n > 1)
    all.mean.error = std::sqrt(disagreement / weight.sum());
  return all;
}

// For a facet measured at one load: the known adhesion over that load.
double adhesion_by_load(const Reading& reading, double adhesion) {
  return reading.is_single() ? adhesion / reading.load : 0;
}

// The offset of the detector, from where an inclined facet's line of Delta meets zero load.
Value detector_offset(const Reading& inclined, const Pair& pair) {
  const double s = portable::sin(inclined.facet.slope), c = portable::cos(inclined.facet.slope);
  const double mu2 = pair.friction * pair.friction;
  const double by_adhesion =
      mu2 * inclined.facet.adhesion->value * s / ((c * c - mu2 * s * s) * pair.sensitivity);
  return {inclined.offset.zero.value - by_adhesion, inclined.offset.zero.error};
}

class Evaluation {
 public:
  // `near_double`: what cannot be told from the double root is given as such.
  Evaluation(const std::vector<Loop>& loops, const Known& known, Root root, bool near_double)
      : known_(known), root_(root), near_double_(near_double), readings_(readings_of(loops)) {
    const auto flat_one = std::ranges::find_if(
        readings_, [](const Reading& r) { return std::abs(r.facet.slope) < flat; });
    if (flat_one != readings_.end()) flat_ = &*flat_one;
    if (flat_) crosstalk_ = flat_->facet.offset;
    for (Reading& reading : readings_)
      if (&reading != flat_) evaluate(reading);
    if (friction_.empty())
      throw std::runtime_error("there is no facet with a slope, allowed: loops on at least one");
    if (flat_) add_tilt();
    if (!offsets_.empty()) take_offset();
  }

  Calibration result() {
    Calibration all;
    all.root = root_;
    all.choice = doubles_ == friction_.size() ? Choice::meeting : Choice::only;
    all.crosstalk = crosstalk_;
    std::size_t i = 0;
    for (Reading& reading : readings_) {
      if (&reading != flat_) {
        reading.facet.friction = with_common(friction_[i]);
        reading.facet.sensitivity = with_common(sensitivity_[i++]);
      }
      all.facets.push_back(reading.facet);
    }
    all.friction = mean_of(friction_).mean;
    const MeanOfFacets mean = mean_of(sensitivity_);
    all.sensitivity = mean.mean;
    all.weights = mean.weights;
    all.disagreement = mean.disagreement;
    if (all.sensitivity.error)
      all.sensitivity.error =
          portable::hypot(*all.sensitivity.error, all.sensitivity.value * known_.load_error);
    if (flat_)
      all.flat_friction = flat_->facet.half_width.value * all.sensitivity.value /
                          (1 + adhesion_by_load(*flat_, known_.adhesion));
    return all;
  }

 private:
  void evaluate(Reading& reading) {
    Facet& facet = reading.facet;
    Level level = flat_ ? level_for(*flat_, reading) : Level{};
    if (flat_) level.tilt = known_.slope_error;
    const bool is_mixed = flat_ && flat_->is_single() && !reading.is_single();
    Signals signals{facet.half_width,
                    facet.offset,
                    {adhesion_by_load(reading, known_.adhesion), {}},
                    facet.slope,
                    false};
    signals.offset.value -= level.by_load;
    if (is_mixed) signals = at_level_load(reading, flat_->load, level);
    const FacetCalibration calibration(signals, level, known_.slope_error);
    const FacetEstimates e = near_double_ && calibration.is_double() ? calibration.at_double_root()
                                                                     : calibration.at_root(root_);
    if (e.is_double) ++doubles_;
    facet.offset.value -= level.by_load;
    if (is_mixed) {
      offsets_.push_back(detector_offset(reading, {e.friction.own.value, e.sensitivity.own.value}));
      facet.offset.value += offsets_.back().value / flat_->load;
    }
    friction_.push_back(e.friction);
    sensitivity_.push_back(e.sensitivity);
  }

  // A flat facet that is tilted shows (1 + mu^2) tilt/sensitivity per load besides the crosstalk.
  void add_tilt() {
    const double mu = mean_of(friction_).mean.value;
    const double tilt =
        (1 + mu * mu) * known_.slope_error / std::abs(mean_of(sensitivity_).mean.value);
    for (auto* estimates : {&friction_, &sensitivity_})
      for (Estimate& e : *estimates) e.common[2] = e.by_offset * tilt;
    if (crosstalk_->error) crosstalk_->error = portable::hypot(*crosstalk_->error, tilt);
  }

  // The crosstalk of a flat facet with one load, without the offset of the detector.
  void take_offset() {
    const double n = static_cast<double>(offsets_.size()) * flat_->load;
    double error2 = 0;
    bool known = crosstalk_->error.has_value();
    for (const Value& offset : offsets_) {
      crosstalk_->value -= offset.value / n;
      error2 += squared(offset.error.value_or(0) / n);
      known = known && offset.error;
    }
    crosstalk_->error = known
                            ? std::optional(portable::hypot(*crosstalk_->error, std::sqrt(error2)))
                            : std::nullopt;
  }

  Known known_;
  Root root_;
  bool near_double_;
  std::size_t doubles_ = 0;
  std::vector<Reading> readings_;
  const Reading* flat_ = nullptr;
  std::optional<Value> crosstalk_;
  std::vector<Estimate> friction_, sensitivity_;
  std::vector<Value> offsets_;  // V, of the detector, where the flat facet has one load
};

// Empty where the upper root would lock the tip, or is negative.
std::optional<Calibration> upper_of(const std::vector<Loop>& loops, const Known& known) {
  try {
    return Evaluation(loops, known, Root::upper, true).result();
  } catch (const std::runtime_error&) {
    return std::nullopt;
  }
}

}  // namespace

std::optional<Roots> roots_of_ratio(double ratio, double load, double adhesion, double slope) {
  constexpr double rounding = 1e-14;  // of b^2: loops of the double root itself
  const double s = portable::sin(slope), c = portable::cos(slope);
  const double a = load * s * c + adhesion * s, b = ratio * (load + adhesion * c);
  const double end = load * s * c;
  double root = b * b - 4 * a * end;
  if (std::abs(root) < rounding * b * b) root = 0;
  // mu > 0 requires both terms to have the same sign.
  if (end == 0 || !(root >= 0) || b * end <= 0) return std::nullopt;
  const double sum = b + std::copysign(std::sqrt(root), b);
  return Roots{2 * end / sum, sum / a > 0 ? std::optional(sum / (2 * a)) : std::nullopt};
}

bool locks(double friction, double slope) {
  return friction * std::abs(portable::sin(slope)) >= portable::cos(slope);
}

double half_width(double load, double adhesion, double friction, double slope) {
  const double s = portable::sin(slope), c = portable::cos(slope);
  return friction * (load + adhesion * c) / (c * c - friction * friction * s * s);
}

Calibration calibrate_at(const std::vector<Loop>& loops, const Known& known, Root root) {
  Calibration all = Evaluation(loops, known, root, false).result();
  all.choice = Choice::given;
  return all;
}

Calibration calibrate(const std::vector<Loop>& loops, const Known& known) {
  Calibration lower = Evaluation(loops, known, Root::lower, true).result();
  std::optional<Calibration> upper = upper_of(loops, known);
  if (lower.choice == Choice::meeting || !upper) return lower;
  lower.other = OtherRoot{upper->friction, upper->sensitivity};
  upper->other = OtherRoot{lower.friction, lower.sensitivity};
  Root root = Root::lower;
  Choice choice = Choice::undecided;
  if (const auto agreeing = agreeing_root(loops, known, lower, *upper)) {
    root = *agreeing;
    choice = Choice::agreement;
  } else if (known.expected) {
    const bool is_above = squared(*known.expected) > lower.friction.value * upper->friction.value;
    root = is_above ? Root::upper : Root::lower;
    choice = Choice::expected;
  }
  lower.choice = upper->choice = choice;
  return root == Root::upper ? *upper : lower;
}

}  // namespace pulvis::wedge
