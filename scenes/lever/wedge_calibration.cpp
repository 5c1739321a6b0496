#include "scenes/lever/wedge_calibration.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <stdexcept>

#include "engine/portable_math.hpp"
#include "scenes/lever/lab_fit.hpp"

namespace pulvis::wedge {
namespace {

constexpr double flat = 1e-6;  // rad: such a slope gives no information

double squared(double x) { return x * x; }

struct Fit {
  Value slope, zero;  // per unit load; at zero load
};

// Through the loops of several loads; `of` and `error_of` select the fitted value.
template <class Of, class ErrorOf>
Fit line_through(const std::vector<Loop>& loops, const Of& of, const ErrorOf& error_of) {
  std::vector<double> load, value;
  for (const Loop& loop : loops) load.push_back(loop.load), value.push_back(of(loop));
  const lab::Line line = lab::fit_line(load, value);
  const auto n = static_cast<double>(loops.size());
  Fit fit{{line.slope, {}}, {line.at(0), {}}};
  double slope2 = 0, zero2 = 0;
  bool known = true;
  for (const Loop& loop : loops) {
    const std::optional<double> error = error_of(loop);
    known = known && error;
    const double on_slope = (loop.load - line.middle) / line.spread;
    const double on_zero = 1 / n - line.middle * on_slope;
    slope2 += squared(on_slope * error.value_or(0));
    zero2 += squared(on_zero * error.value_or(0));
  }
  if (loops.size() > 2) {
    const double scatter2 = line.residual / (n - 2);
    slope2 = std::max(known ? slope2 : 0, scatter2 / line.spread);
    zero2 =
        std::max(known ? zero2 : 0, scatter2 * (1 / n + line.middle * line.middle / line.spread));
    known = true;
  }
  if (known) fit.slope.error = std::sqrt(slope2), fit.zero.error = std::sqrt(zero2);
  return fit;
}

// Loops at one load: their mean over the load.
template <class Of, class ErrorOf>
Value mean_by_load(const std::vector<Loop>& loops, const Of& of, const ErrorOf& error_of) {
  const auto n = static_cast<double>(loops.size());
  double sum = 0, squares = 0, error2 = 0;
  bool known = true;
  for (const Loop& loop : loops) {
    const double value = of(loop) / loop.load;
    sum += value;
    squares += value * value;
    known = known && error_of(loop);
    error2 += squared(error_of(loop).value_or(0) / loop.load / n);
  }
  const double mean = sum / n;
  if (loops.size() > 2) {
    const double scatter2 = std::max(0.0, squares / n - mean * mean) / (n - 1);
    error2 = std::max(known ? error2 : 0, scatter2);
    known = true;
  }
  return {mean, known ? std::optional(std::sqrt(error2)) : std::nullopt};
}

Facet facet_of(const std::vector<Loop>& loops) {
  Facet facet;
  facet.slope = loops.front().slope;
  facet.loops = static_cast<int>(loops.size());
  std::set<double> loads;
  for (const Loop& loop : loops) loads.insert(loop.load);
  facet.loads = static_cast<int>(loads.size());
  const auto width = [](const Loop& loop) { return loop.half_width; };
  const auto width_error = [](const Loop& loop) { return loop.half_width_error; };
  const auto offset = [](const Loop& loop) { return loop.offset; };
  const auto offset_error = [](const Loop& loop) { return loop.offset_error; };
  if (facet.loads == 1) {
    if (loops.front().load == 0)
      throw std::runtime_error(
          "a facet was measured at zero load only, allowed: loads other than 0");
    facet.half_width = mean_by_load(loops, width, width_error);
    facet.offset = mean_by_load(loops, offset, offset_error);
    return facet;
  }
  const Fit w = line_through(loops, width, width_error);
  facet.half_width = w.slope;
  facet.offset = line_through(loops, offset, offset_error).slope;
  const double adhesion = w.zero.value / (w.slope.value * portable::cos(facet.slope));
  facet.adhesion = Value{adhesion, {}};
  if (w.zero.error && w.slope.error)
    facet.adhesion->error =
        portable::hypot(*w.zero.error / (w.slope.value * portable::cos(facet.slope)),
                        adhesion * *w.slope.error / w.slope.value);
  return facet;
}

struct Pair {
  double friction = 0, sensitivity = 0;
};

// From volts per load; `adhesion` over the load, 0 where the volts are slopes over several loads.
std::optional<Pair> solve(double width, double offset, double adhesion, double slope) {
  const auto mu = friction_of_ratio(offset / width, 1, adhesion, slope);
  if (!mu) return std::nullopt;
  const double s = portable::sin(slope), c = portable::cos(slope);
  return Pair{*mu, *mu * (1 + adhesion * c) / (c * c - *mu * *mu * s * s) / width};
}

// A facet's figure, its error without that of the crosstalk, and its derivative with respect to the offset,
// from which the crosstalk was subtracted: that error is common to all facets.
struct Estimate {
  Value own;
  double by_offset = 0;
};

struct FacetEstimates {
  Estimate friction, sensitivity;
};

FacetEstimates calibrate_facet(const Facet& facet, double adhesion, double slope_error) {
  const std::array<double, 3> at{facet.half_width.value, facet.offset.value, facet.slope};
  const auto of = [&](const std::array<double, 3>& x) { return solve(x[0], x[1], adhesion, x[2]); };
  const auto pair = of(at);
  if (!pair)
    throw std::runtime_error(fmt::format(
        "on the slope of {:g} deg there is no matching friction coefficient: 2 (Delta/W)/sin 2 "
        "theta is {:.4g}, allowed: >= 2",
        facet.slope * 180 / std::numbers::pi, 2 * at[1] / at[0] / portable::sin(2 * facet.slope)));
  FacetEstimates e{{{pair->friction, {}}, 0}, {{pair->sensitivity, {}}, 0}};
  if (!facet.half_width.error || !facet.offset.error) return e;
  const std::array<double, 3> error{*facet.half_width.error, *facet.offset.error, slope_error};
  double friction2 = 0, sensitivity2 = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    auto up = at, down = at;
    const double step = 1e-6 * std::abs(at[i]);
    up[i] += step, down[i] -= step;
    const auto a = of(up), b = of(down);
    if (!a || !b) return e;  // at the limit of the solvable range: error unknown
    const double by_friction = (a->friction - b->friction) / (2 * step);
    const double by_sensitivity = (a->sensitivity - b->sensitivity) / (2 * step);
    friction2 += squared(by_friction * error[i]);
    sensitivity2 += squared(by_sensitivity * error[i]);
    if (i == 1) e.friction.by_offset = by_friction, e.sensitivity.by_offset = by_sensitivity;
  }
  e.friction.own.error = std::sqrt(friction2);
  e.sensitivity.own.error = std::sqrt(sensitivity2);
  return e;
}

Value with_crosstalk(const Estimate& e, const std::optional<Value>& crosstalk) {
  if (!crosstalk || !e.own.error) return e.own;
  if (!crosstalk->error) return {e.own.value, {}};
  return {e.own.value, portable::hypot(*e.own.error, e.by_offset * *crosstalk->error)};
}

// Mean of estimates with correlated errors (Aitken 1936); without errors a plain mean and its scatter.
struct MeanOfFacets {
  Value mean;
  std::vector<double> weights;  // their sum is 1
  double disagreement = 0;      // Birge ratio squared; only for estimates with errors
};

MeanOfFacets mean_of(const std::vector<Estimate>& estimates,
                     const std::optional<Value>& crosstalk) {
  const auto n = static_cast<Eigen::Index>(estimates.size());
  Eigen::VectorXd value(n), by_offset(n);
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(n, n);
  bool weighted = !crosstalk || crosstalk->error;
  for (Eigen::Index i = 0; i < n; ++i) {
    const Estimate& e = estimates[static_cast<std::size_t>(i)];
    value[i] = e.own.value;
    by_offset[i] = e.by_offset;
    weighted = weighted && e.own.error && *e.own.error > 0;
    covariance(i, i) = e.own.error ? *e.own.error * *e.own.error : 0;
  }
  const double shared = crosstalk ? crosstalk->error.value_or(0) : 0;
  if (weighted)
    covariance += shared * shared * by_offset * by_offset.transpose();
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

std::vector<Facet> facets_of(const std::vector<Loop>& loops) {
  std::map<double, std::vector<Loop>> by_slope;
  for (const Loop& loop : loops) by_slope[loop.slope].push_back(loop);
  std::vector<Facet> facets;
  for (const auto& [slope, own] : by_slope) {
    if (!(std::abs(slope) < std::numbers::pi / 2))
      throw std::runtime_error(fmt::format("a slope of {:g} deg, allowed: between -90 and 90 deg",
                                           slope * 180 / std::numbers::pi));
    facets.push_back(facet_of(own));
    if (facets.back().half_width.value == 0)
      throw std::runtime_error(fmt::format("the loops on {:g} deg have no width, allowed: friction",
                                           slope * 180 / std::numbers::pi));
  }
  return facets;
}

// For a facet measured at one load: the known adhesion over that load.
double adhesion_by_load(const Facet& facet, const std::vector<Loop>& loops, double adhesion) {
  if (facet.loads > 1) return 0;
  const auto own = std::ranges::find(loops, facet.slope, &Loop::slope);
  return adhesion / own->load;
}

}  // namespace

std::optional<double> friction_of_ratio(double ratio, double load, double adhesion, double slope) {
  const double s = portable::sin(slope), c = portable::cos(slope);
  const double a = load * s * c + adhesion * s, b = ratio * (load + adhesion * c);
  const double end = load * s * c, root = b * b - 4 * a * end;
  // mu > 0 requires both terms to have the same sign.
  if (end == 0 || !(root >= 0) || b * end <= 0) return std::nullopt;
  return 2 * end / (b + std::copysign(std::sqrt(root), b));
}

Calibration calibrate(const std::vector<Loop>& loops, const Known& known) {
  Calibration all;
  all.facets = facets_of(loops);
  const auto level = std::ranges::find_if(
      all.facets, [](const Facet& facet) { return std::abs(facet.slope) < flat; });
  if (level != all.facets.end()) all.crosstalk = level->offset;
  std::vector<Estimate> friction, sensitivity;
  for (Facet& facet : all.facets) {
    if (std::abs(facet.slope) < flat) continue;
    if (all.crosstalk) facet.offset.value -= all.crosstalk->value;
    const FacetEstimates e =
        calibrate_facet(facet, adhesion_by_load(facet, loops, known.adhesion), known.slope_error);
    facet.friction = with_crosstalk(e.friction, all.crosstalk);
    facet.sensitivity = with_crosstalk(e.sensitivity, all.crosstalk);
    friction.push_back(e.friction);
    sensitivity.push_back(e.sensitivity);
  }
  if (friction.empty())
    throw std::runtime_error("there is no facet with a slope, allowed: loops on at least one");
  all.friction = mean_of(friction, all.crosstalk).mean;
  const MeanOfFacets mean = mean_of(sensitivity, all.crosstalk);
  all.sensitivity = mean.mean;
  all.weights = mean.weights;
  all.disagreement = mean.disagreement;
  if (all.sensitivity.error)
    all.sensitivity.error =
        portable::hypot(*all.sensitivity.error, all.sensitivity.value * known.load_error);
  if (level != all.facets.end())
    all.flat_friction = level->half_width.value * all.sensitivity.value /
                        (1 + adhesion_by_load(*level, loops, known.adhesion));
  return all;
}

}  // namespace pulvis::wedge
