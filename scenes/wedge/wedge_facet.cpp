#include "scenes/wedge/wedge_facet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "engine/portable_math.hpp"
#include "scenes/wedge/wedge_readings.hpp"

namespace pulvis::wedge {
namespace {

// Standard uncertainties of Delta/W above its smallest value: nearer, the linear propagation to a root fails.
constexpr double told_apart = 3;

// Central differences with respect to the four values of the signals; empty where `of` has no value.
template <class Of>
std::optional<std::array<double, 4>> derivatives(const std::array<double, 4>& at, const Of& of) {
  std::array<double, 4> by{};
  for (std::size_t i = 0; i < at.size(); ++i) {
    auto up = at, down = at;
    const double step = 1e-6 * (i == 3 ? 1 : std::abs(at[i]));
    up[i] += step, down[i] -= step;
    const std::optional<double> a = of(up), b = of(down);
    if (!a || !b) return std::nullopt;
    by[i] = (*a - *b) / (2 * step);
  }
  return by;
}

[[noreturn]] void refuse_ratio(const PerLoad& seen) {
  const double degrees = seen.slope * 180 / std::numbers::pi;
  const auto roots = roots_of_ratio(seen.offset / seen.width, 1, seen.adhesion, seen.slope);
  if (roots)
    throw std::runtime_error(fmt::format(
        "on the slope of {:g} deg a friction coefficient of {:.4g} fits, with which no force moves "
        "the tip uphill, allowed: < {:.4g}, 1/tan theta",
        degrees, roots->lower,
        1 / std::abs(portable::sin(seen.slope) / portable::cos(seen.slope))));
  throw std::runtime_error(fmt::format(
      "on the slope of {:g} deg there is no matching friction coefficient: 2 (Delta/W)/sin 2 "
      "theta is {:.4g}, allowed: >= 2",
      degrees, 2 * seen.offset / seen.width / portable::sin(2 * seen.slope)));
}

}  // namespace

std::optional<Pair> PerLoad::solved(Root root) const {
  const auto roots = roots_of_ratio(offset / width, 1, adhesion, slope);
  if (!roots || (root == Root::upper && !roots->upper)) return std::nullopt;
  const double mu = root == Root::upper ? *roots->upper : roots->lower;
  if (locks(mu, slope)) return std::nullopt;
  return at(mu);
}

double PerLoad::double_root() const { return 1 / std::sqrt(1 + adhesion / portable::cos(slope)); }

double PerLoad::excess() const {
  const double s = portable::sin(slope), c = portable::cos(slope);
  return 0.5 * offset / width * (1 + adhesion * c) / (s * c) * double_root() - 1;
}

PerLoad Signals::at(const std::array<double, 4>& x) const {
  return {is_mixed ? x[0] * (1 + x[3] * portable::cos(x[2])) : x[0], x[1], x[3], x[2]};
}

FacetCalibration::FacetCalibration(const Signals& signals, const Level& level, double slope_error)
    : signals_(signals), level_(level), at_(signals.values()) {
  if (!signals.half_width.error || !signals.offset.error) return;
  errors_ = {*signals.half_width.error, *signals.offset.error, slope_error,
             signals.adhesion.error.value_or(0)};
  errors_known_ = true;
}

bool FacetCalibration::is_double() const {
  const PerLoad seen = signals_.at(at_);
  const double error = excess_error();
  return error > 0 && std::abs(seen.excess()) < told_apart * error;
}

FacetEstimates FacetCalibration::at_double_root() const {
  const PerLoad seen = signals_.at(at_);
  const double share = std::sqrt(2 * (std::max(seen.excess(), 0.0) + excess_error()));
  const double mu = seen.double_root();
  if (locks(mu, seen.slope)) refuse_ratio(seen);
  const auto sensitivity = [&](double friction) { return seen.at(friction).sensitivity; };
  const double step = 1e-6 * mu;
  const double by_friction = (sensitivity(mu + step) - sensitivity(mu - step)) / (2 * step);
  FacetEstimates e;
  e.is_double = true;
  e.friction.own = {mu, mu * share};
  e.sensitivity.own = {sensitivity(mu),
                       portable::hypot(by_friction * mu * share,
                                       sensitivity(mu) * errors_[0] / signals_.half_width.value)};
  e.friction.errors_known = e.sensitivity.errors_known = level_.errors_known;
  return e;
}

FacetEstimates FacetCalibration::at_root(Root root) const {
  const auto pair = signals_.at(at_).solved(root);
  if (!pair) refuse_ratio(signals_.at(at_));
  FacetEstimates e;
  e.friction.own.value = pair->friction;
  e.sensitivity.own.value = pair->sensitivity;
  if (!errors_known_) return e;
  propagate(e.friction, root, &Pair::friction);
  propagate(e.sensitivity, root, &Pair::sensitivity);
  return e;
}

double FacetCalibration::excess_error() const {
  if (!errors_known_) return 0;
  const auto by = derivatives(at_, [&](const std::array<double, 4>& x) {
                    return std::optional(signals_.at(x).excess());
                  }).value();
  double squares = 0;
  for (std::size_t i = 0; i < by.size(); ++i) squares += squared(by[i] * errors_[i]);
  const PerLoad seen = signals_.at(at_);
  const double mu = seen.double_root();
  const double tilt = (1 + mu * mu) * level_.tilt / std::abs(seen.at(mu).sensitivity);
  for (const double error : {level_.errors[0], level_.errors[1], tilt})
    squares += squared(by[1] * error);
  return std::sqrt(squares);
}

void FacetCalibration::propagate(Estimate& estimate, Root root, double Pair::*figure) const {
  const auto by = derivatives(at_, [&](const std::array<double, 4>& x) {
    const auto pair = signals_.at(x).solved(root);
    return pair ? std::optional((*pair).*figure) : std::nullopt;
  });
  if (!by) return;  // at the limit of the solvable range: error unknown
  double squares = 0;
  for (std::size_t i = 0; i < by->size(); ++i) squares += squared((*by)[i] * errors_[i]);
  estimate.own.error = std::sqrt(squares);
  estimate.by_offset = (*by)[1];
  estimate.errors_known = level_.errors_known;
  estimate.common.head<2>() =
      estimate.by_offset * Eigen::Vector2d(level_.errors[0], level_.errors[1]);
}

}  // namespace pulvis::wedge
