#include "cli/laboratory/lab_press.hpp"

#include "scenes/solve/lab_fit.hpp"
#include "scenes/solve/least_squares.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace pulvis::lab {
namespace {

constexpr std::size_t fewest_loading = 20;  // samples
constexpr double unloaded = 0.1;            // of the largest pressure
// The solid itself is compressed: by a tenth at 1 GPa on a bulk modulus of 10 GPa, that of organic powders.
constexpr double densest_loaded = 1.1;
constexpr double unloads_from = 0.9, unloads_until = 0.4;  // of the largest pressure: modulus

std::size_t peak_of(const std::vector<double>& force) {
  return static_cast<std::size_t>(std::ranges::max_element(force) - force.begin());
}

// The first sample after which the force stays above the contact threshold, up to the peak.
std::size_t begin_of(const std::vector<double>& force, std::size_t peak, double share) {
  std::size_t begin = peak;
  while (begin > 0 && force[begin - 1] > share * force[peak]) --begin;
  return begin;
}

void check_single(const PressRecord& record, std::size_t begin, std::size_t peak, double share) {
  double highest = 0;
  for (std::size_t i = begin; i <= peak; ++i) {
    highest = std::max(highest, record.force[i]);
    if (highest - record.force[i] > share * record.force[peak])
      refuse(
          record, i, "force",
          fmt::format("drops from {:.4g} N to {:.4g} N before its largest value of {:.4g} N: not a "
                      "single loading, allowed: a drop of {:g} of that (compression.largest_fall)",
                      highest, record.force[i], record.force[peak], share));
  }
  if (peak - begin + 1 < fewest_loading)
    refuse(record, peak, "force",
           fmt::format("the loading has {} samples, allowed: at least {}", peak - begin + 1,
                       fewest_loading));
}

// Coefficients of F, F^2, ... from those of (F/scale)^k.
std::vector<double> per_force(const Eigen::VectorXd& c, double scale) {
  std::vector<double> coefficients;
  double unit = 1;
  for (Eigen::Index k = 1; k < c.size(); ++k) coefficients.push_back(c[k] / (unit *= scale));
  return coefficients;
}

// Columns: one standard uncertainty of the least-squares fit each, independent of one another.
Eigen::MatrixXd independent_errors(const Eigen::MatrixXd& powers,
                                   const Eigen::VectorXd& residuals) {
  const double r = neighbour_correlation(residuals);
  const double variance =
      residuals.squaredNorm() / static_cast<double>(powers.rows() - powers.cols());
  const Eigen::MatrixXd inverse = (powers.transpose() * powers).inverse();
  return std::sqrt(variance * (1 + r) / (1 - r)) * Eigen::MatrixXd(inverse.llt().matrixL());
}

}  // namespace

double DieSpec::area() const {
  return is_slot() ? width * thickness : std::numbers::pi / 4 * diameter * diameter;
}

double DieSpec::wall_length() const { return is_slot() ? width / 2 : diameter / 4; }

double Compliance::at(double force) const {
  double give = 0;
  for (std::size_t i = coefficients.size(); i-- > 0;) give = (give + coefficients[i]) * force;
  return give;
}

Compliance compliance_of(const PressRecord& empty, const CompressionSpec& spec) {
  const std::size_t peak = peak_of(empty.force);
  const std::size_t begin = begin_of(empty.force, peak, spec.contact);
  check_single(empty, begin, peak, spec.largest_fall);
  const auto n = static_cast<Eigen::Index>(peak - begin + 1);
  const Eigen::Index terms = spec.empty_degree + 1;
  const double scale = empty.force[peak];
  Eigen::MatrixXd powers(n, terms);
  Eigen::VectorXd u(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto at = begin + static_cast<std::size_t>(i);
    u[i] = empty.displacement[at];
    powers(i, 0) = 1;
    for (Eigen::Index k = 1; k < terms; ++k)
      powers(i, k) = powers(i, k - 1) * empty.force[at] / scale;
  }
  const Eigen::VectorXd c = least_squares(powers, u), residuals = u - powers * c;
  Compliance found;
  found.meeting = c[0];
  found.coefficients = per_force(c, scale);
  found.largest_force = scale;
  found.rms = std::sqrt(residuals.squaredNorm() / static_cast<double>(n));
  found.samples = static_cast<std::size_t>(n);
  const Eigen::MatrixXd errors = independent_errors(powers, residuals);
  for (Eigen::Index k = 0; k < terms; ++k)
    found.errors.push_back({errors(0, k), per_force(errors.col(k), scale)});
  return found;
}

Compliance machine_of(const Settings& settings) {
  const CompressionSpec& spec = settings.compression;
  if (spec.empty.empty()) return {spec.compliance, {}, 0, 0, 0, {}};
  return compliance_of(read_press(settings.file.parent_path() / spec.empty, settings), spec);
}

double displacement_noise(const PressRecord& record) {
  const std::vector<double>& u = record.displacement;
  std::vector<double> bends;
  for (std::size_t i = 1; i + 1 < u.size(); ++i)
    bends.push_back(std::abs(u[i - 1] - 2 * u[i] + u[i + 1]));
  if (bends.empty()) return 0;
  const auto middle = bends.begin() + static_cast<std::ptrdiff_t>(bends.size() / 2);
  std::ranges::nth_element(bends, middle);
  return *middle / (0.6745 * std::sqrt(6.0));
}

PressCurve press_curve(const PressRecord& record, const Filling& filling, const DieSpec& die,
                       const CompressionSpec& spec, const Compliance& machine) {
  const std::size_t peak = peak_of(record.force);
  const std::size_t begin = begin_of(record.force, peak, spec.contact);
  check_single(record, begin, peak, spec.largest_fall);
  if (machine.largest_force > 0 && record.force[peak] > 1.001 * machine.largest_force)
    refuse(record, peak, "force",
           fmt::format("{:.5g} N is beyond the range of the record of the empty press, allowed: up "
                       "to {:.5g} N",
                       record.force[peak], machine.largest_force));
  const auto shortening = [&](std::size_t i) {
    return record.displacement[i] - machine.at(record.force[i]);
  };
  double zero = machine.meeting.value_or(0);
  if (filling.fill_height) zero = *filling.fill_height;
  if (filling.final_height) zero = *filling.final_height + shortening(record.force.size() - 1);
  PressCurve curve;
  const double solid_height = filling.mass / (die.solid_density * die.area());
  for (std::size_t i = begin; i < record.force.size(); ++i) {
    const double height = zero - shortening(i);
    if (!(height > 0))
      refuse(record, i, "displacement",
             fmt::format("the compact would be {:.4g} mm high, allowed: > 0 (check its height and "
                         "the press compliance)",
                         height * 1e3));
    curve.height.push_back(height);
    curve.density.push_back(solid_height / height);
    curve.pressure.push_back(record.force[i] / die.area());
  }
  curve.first = begin;
  curve.peak = peak - begin;
  curve.machine_give = machine.at(record.force[peak]);
  return curve;
}

void check_density(const PressRecord& record, const PressCurve& curve, const DieSpec& die) {
  const std::size_t last = curve.height.size() - 1;
  const bool is_unloaded = curve.pressure[last] < unloaded * curve.pressure[curve.peak];
  const double margin = 2 * std::hypot(die.mass_error, die.height_error / curve.height[last]);
  const auto check = [&](std::size_t at, double most, const char* state) {
    if (curve.density[at] > most)
      refuse(record, curve.first + at, "displacement",
             fmt::format("the relative density is {:.4g} {}, allowed: up to {:.4g} (check mass, "
                         "die.solid_density, the section of the die and the height)",
                         curve.density[at], state, most));
  };
  if (is_unloaded) check(last, 1 + margin, "without load");
  check(curve.peak, densest_loaded + margin, "under the largest force");
}

std::optional<Unloading> unloading_of(const PressCurve& curve) {
  const std::size_t last = curve.height.size() - 1;
  const double largest = curve.pressure[curve.peak];
  if (last <= curve.peak || curve.pressure[last] > unloads_until * largest) return std::nullopt;
  Unloading found;
  const double lowest = curve.height[curve.peak];
  found.last_pressure = curve.pressure[last];
  found.last_density = curve.density[last];
  found.recovery = (curve.height[last] - lowest) / lowest;
  std::vector<double> strain, pressure;
  for (std::size_t i = curve.peak; i <= last && curve.pressure[i] > unloads_until * largest; ++i) {
    if (curve.pressure[i] > unloads_from * largest) continue;
    strain.push_back((lowest - curve.height[i]) / lowest);
    pressure.push_back(curve.pressure[i]);
  }
  constexpr std::size_t fewest = 5;
  if (strain.size() < fewest) return found;
  // Strain as a function of pressure: the larger errors are those of the displacement.
  const double slope = fit_line(pressure, strain).slope;
  if (slope > 0) found.modulus = 1 / slope;
  return found;
}

}  // namespace pulvis::lab
