#include "cli/campaigns/fit/plate_comparison.hpp"

#include <fmt/format.h>

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "scenes/language/csv_table.hpp"
#include "scenes/outlines/outline.hpp"
#include "scenes/packing/place.hpp"
#include "scenes/solve/lab_fit.hpp"
#include "scenes/solve/least_squares.hpp"

namespace pulvis {
namespace {

constexpr std::size_t fewest_compared = 20;  // samples of a record
constexpr double certain = 1e6;              // degrees of freedom of a stated uncertainty
constexpr double distance_noise =
    0.02;  // share of the record's range by which the distance may fall

double mean_diameter(const Scene& scene) {
  const std::vector<BodySpec> bodies = place_bodies(scene);
  double sum = 0;
  for (const BodySpec& body : bodies) {
    const auto& outline = scene.particles[static_cast<std::size_t>(body.particle)].outline;
    sum += std::sqrt(4 * outline_area(outline) / std::numbers::pi);
  }
  return sum / static_cast<double>(bodies.size());
}

// J'J may not be inverted as it is: the units of the parameters differ by many orders.
struct ScaledSlopes {
  Eigen::VectorXd lengths;  // of the columns of J; 1 if it is 0
  Eigen::MatrixXd slopes;   // J with columns of length 1

  explicit ScaledSlopes(const Eigen::MatrixXd& jacobian)
      : lengths(jacobian.colwise().norm().transpose()) {
    for (double& length : lengths)
      if (!(length > 0)) length = 1;
    slopes = jacobian * lengths.cwiseInverse().asDiagonal();
  }
  // Directions in which the residuals do not change, one per column.
  Eigen::MatrixXd null_space() const {
    constexpr double no_effect = 1e-6;  // the curves have nine digits
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(slopes, Eigen::ComputeFullV);
    const Eigen::VectorXd& effects = svd.singularValues();
    const auto rank = (effects.array() > no_effect * effects.maxCoeff()).count();
    return svd.matrixV().rightCols(slopes.cols() - rank);
  }
  // Standard errors of the parameters for residuals of unit variance; infinite where others can make up for a change.
  Eigen::VectorXd errors() const {
    constexpr double no_part = 1e-4;
    const Eigen::MatrixXd inverse = pseudo_inverse(slopes.transpose() * slopes),
                          free = null_space();
    Eigen::VectorXd found(lengths.size());
    for (Eigen::Index k = 0; k < lengths.size(); ++k)
      found[k] = free.row(k).norm() > no_part
                     ? std::numeric_limits<double>::infinity()
                     : std::sqrt(std::max(0.0, inverse(k, k))) / lengths[k];
    return found;
  }
};

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& key,
                         const std::string& what) {
  throw SceneError({{file.string(), 1, 1, "", key, what}});
}

// Each sample is compared at its own distance, so those of a return stroke would be taken for a second forward one.
// `low` to `high`: the compared range, on the scale of the record.
void require_forward(const csv::Table& table, std::size_t column,
                     const std::vector<double>& distance, double low, double high) {
  if (distance.empty()) return;
  const auto [least, most] = std::ranges::minmax(distance);
  const double allowed = distance_noise * (most - std::max(least, 0.0));
  std::size_t farthest = 0;
  for (std::size_t i = 0; i < distance.size(); ++i) {
    if (distance[i] > distance[farthest]) farthest = i;
    if (distance[i] < low || distance[i] > high || distance[farthest] - distance[i] <= allowed)
      continue;
    csv::refuse(
        table, i, column,
        fmt::format("falls to {:.6g} mm after {:.6g} mm in line {}, allowed: a single "
                    "forward stroke, whose distance falls by at most {:.3g} mm (noise, {:g}% "
                    "of the range of the record)",
                    distance[i] * 1e3, distance[farthest] * 1e3, table.lines[farthest],
                    allowed * 1e3, distance_noise * 100));
  }
}

}  // namespace

double static_coefficient(const lab::SimulatedCurve& curve, double within) {
  double largest = curve.friction.front();
  for (std::size_t i = 0; i < curve.distance.size() && curve.distance[i] <= within; ++i)
    largest = std::max(largest, curve.friction[i]);
  return largest;
}

double dynamic_coefficient(const lab::SimulatedCurve& curve, double from) {
  double area = 0, way = 0;
  for (std::size_t i = 1; i < curve.distance.size(); ++i) {
    if (curve.distance[i - 1] < from) continue;
    const double step = curve.distance[i] - curve.distance[i - 1];
    area += step * (curve.friction[i] + curve.friction[i - 1]) / 2;
    way += step;
  }
  return area / way;
}

PlateComparison::PlateComparison(const PlateFit& fit)
    : fit_(fit), simulated_diameter_(mean_diameter(fit.scene)) {
  const PlateMeasured& m = fit.spec.measured;
  if (!has_record()) return;
  const csv::Table all = csv::read(fit.file.parent_path() / m.record);
  const std::size_t friction_column = csv::column_at(all, m.friction);
  const csv::Table table = csv::with_value(all, friction_column);
  const std::size_t distance_column = csv::column_at(table, m.distance);
  const std::vector<double> distance = csv::numbers(table, distance_column, "m");
  const std::vector<double> friction = csv::numbers(table, friction_column, "");
  const double scale = m.by_diameters() ? simulated_diameter_ / *m.particle_diameter : 1;
  for (std::size_t i = 0; i < distance.size(); ++i) {
    if (distance[i] < 0) continue;  // before the plate started
    measured_way_ = std::max(measured_way_, distance[i]);
    distance_.push_back(scale * distance[i]);
    friction_.push_back(friction[i]);
  }
  // Before anything runs; set_reach does so again with the way of the simulated plate.
  const double end = m.until.value_or(distance_.empty() ? 0 : std::ranges::max(distance_));
  require_samples(end);
  require_forward(table, distance_column, distance, from() / scale, end / scale);
}

void PlateComparison::require_samples(double until) {
  if (until < from())
    refuse(fit_.file, "measured.record",
           fmt::format("the compared range would end at {:.4g} mm, allowed: beyond its start at "
                       "{:.4g} mm (measured.from)",
                       until * 1e3, from() * 1e3));
  compared_.clear();
  for (std::size_t i = 0; i < distance_.size(); ++i)
    if (distance_[i] >= from() && distance_[i] <= until) compared_.push_back(i);
  if (compared_.size() < fewest_compared)
    refuse(fit_.file, "measured.record",
           fmt::format("{} of its samples lie between {:.4g} and {:.4g} mm, allowed: at least {} "
                       "in the compared range",
                       compared_.size(), from() * 1e3, until * 1e3, fewest_compared));
}

void PlateComparison::set_reach(const lab::SimulatedCurve& simulated) {
  const PlateMeasured& m = fit_.spec.measured;
  simulated_way_ = simulated.distance.back();
  until_ = simulated_way_;
  if (!has_record()) {
    if (m.dynamic && !(fit_.spec.dynamic_from < 0.95 * simulated_way_))
      refuse(fit_.file, "fit.dynamic_from",
             fmt::format("{:.4g} mm, but the simulated target slides only {:.4g} mm, allowed: less "
                         "than 95% of that",
                         fit_.spec.dynamic_from * 1e3, simulated_way_ * 1e3));
    return;
  }
  const double recorded = distance_.empty() ? 0 : std::ranges::max(distance_);
  until_ = std::min({until_, recorded, m.until.value_or(until_)});
  require_samples(until_);
}

Eigen::VectorXd PlateComparison::residuals(const lab::SimulatedCurve& simulated) const {
  const PlateMeasured& m = fit_.spec.measured;
  std::vector<double> all;
  for (const std::size_t i : compared_)
    all.push_back(
        (lab::interpolated(simulated.distance, simulated.friction, distance_[i]) - friction_[i]) /
        m.error.value_or(1));
  if (m.peak)
    all.push_back((static_coefficient(simulated, fit_.spec.static_within) - *m.peak) /
                  *m.peak_error);
  if (m.dynamic)
    all.push_back((dynamic_coefficient(simulated, fit_.spec.dynamic_from) - *m.dynamic) /
                  *m.dynamic_error);
  return Eigen::Map<const Eigen::VectorXd>(all.data(), static_cast<Eigen::Index>(all.size()));
}

std::vector<std::string> PlateComparison::limits() const {
  const PlateMeasured& m = fit_.spec.measured;
  std::vector<std::string> told;
  const double own = simulated_way_ / simulated_diameter_;
  told.push_back(
      fmt::format("The simulated target slides {:.4g} mm, {:.2g} particle diameters of {:.4g} mm.",
                  simulated_way_ * 1e3, own, simulated_diameter_ * 1e3));
  if (has_record() && m.particle_diameter)
    told.push_back(fmt::format(
        "The record is {:.4g} mm long, {:.3g} particle diameters of {:.4g} mm.",
        measured_way_ * 1e3, measured_way_ / *m.particle_diameter, *m.particle_diameter * 1e3));
  if (has_record() && std::ranges::max(distance_) > until_)
    told.push_back(fmt::format("Not compared: the record beyond {:.4g} mm of the simulated travel.",
                               until_ * 1e3));
  if (has_record() && from() > 0)
    told.push_back(fmt::format("Not compared: the first {:.4g} mm.", from() * 1e3));
  if (own < 1)
    told.push_back(
        "No simulated particle has moved by its own diameter: effects of particle rearrangement in "
        "the record must not be compared.");
  if (has_record() && m.particle_diameter && !m.by_diameters()) {
    const double ratio = simulated_diameter_ / *m.particle_diameter;
    if (ratio > 2 || ratio < 0.5)
      told.push_back(fmt::format(
          "Compared at equal distances, although the diameters differ by a factor of {:.3g}: only "
          "effects of surface slip may be compared, not those of rearrangement.",
          ratio));
  }
  if (has_record() && m.by_diameters())
    told.push_back(
        "Compared at equal multiples of the diameters: lengths of the surfaces, such as a decay "
        "length, are then those of the simulation, not of the plate.");
  return told;
}

std::vector<lab::Measured> PlateComparison::parameters(const std::vector<double>& values,
                                                       const Eigen::VectorXd& residuals,
                                                       const Eigen::MatrixXd& jacobian) const {
  const PlateMeasured& m = fit_.spec.measured;
  const Eigen::VectorXd errors = ScaledSlopes(jacobian).errors();
  double variance = 1, freedom = certain;
  const char* source = "stated";
  if (has_record()) {
    const auto n = static_cast<double>(residuals.size()), p = static_cast<double>(values.size());
    const Eigen::Index count = residuals.size();
    const double squares = residuals.squaredNorm();
    const double r =
        squares > 0 ? std::clamp(residuals.head(count - 1).dot(residuals.tail(count - 1)) / squares,
                                 0.0, 0.99)
                    : 0;
    variance = squares / (n - p) * (1 + r) / (1 - r);
    freedom = std::max(1.0, n * (1 - r) / (1 + r) - p);
    source = "scatter";
    if (m.error && variance < 1) variance = 1, freedom = certain, source = "stated";
  }
  std::vector<lab::Measured> found;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const SoughtKey& sought = fit_.spec.parameters[k];
    found.push_back({sought.short_name(),
                     sought.unit.empty() ? "-" : sought.unit,
                     values[k],
                     freedom,
                     {{source, std::sqrt(variance) * errors[static_cast<Eigen::Index>(k)]}}});
  }
  return found;
}

}  // namespace pulvis
