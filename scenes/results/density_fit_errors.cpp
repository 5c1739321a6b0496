#include "scenes/results/density_fit_errors.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <limits>

#include "scenes/solve/least_squares.hpp"

namespace pulvis {
namespace {

using Parameters = std::vector<double>;

double heckel(const Parameters& q, double p) { return q[0] * p + q[1]; }
double kawakita(const Parameters& q, double p) { return p / q[0] + 1 / (q[0] * q[1]); }
double cooper_eaton_sum(const Parameters& q, double p) {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < q.size(); i += 2) sum += q[i] * std::exp(-q[i + 1] / p);
  return sum;
}

struct Law {
  double (*ordinate)(const Parameters&, double pressure);
  double (*measured)(double density, double first_density, double pressure);
};

Law law_of(const std::string& name) {
  if (name == "heckel") return {heckel, [](double d, double, double) { return -std::log(1 - d); }};
  if (name == "kawakita")
    return {kawakita, [](double d, double d0, double p) { return p / (1 - d0 / d); }};
  return {cooper_eaton_sum, [](double d, double d0, double) { return (1 - d0 / d) / (1 - d0); }};
}

// The fitted parameters: Heckel's yield pressure follows from K.
Parameters free_parameters(const DensityFit& fit) {
  Parameters q;
  for (const FitParameter& p : fit.parameters)
    if (p.name != "yield_pressure") q.push_back(p.value);
  return q;
}

// Columns scaled by the parameters: derivatives with respect to their relative changes.
Eigen::MatrixXd derivatives(const Law& law, const Parameters& at, const FitRange& range) {
  constexpr double step = 1e-5;
  Eigen::MatrixXd j(static_cast<Eigen::Index>(range.pressure.size()),
                    static_cast<Eigen::Index>(at.size()));
  for (std::size_t k = 0; k < at.size(); ++k) {
    Parameters up = at, down = at;
    up[k] *= 1 + step;
    down[k] *= 1 - step;
    for (std::size_t i = 0; i < range.pressure.size(); ++i)
      j(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) =
          (law.ordinate(up, range.pressure[i]) - law.ordinate(down, range.pressure[i])) /
          (2 * step);
  }
  return j;
}

}  // namespace

FitErrors fit_errors(const DensityFit& fit, const FitRange& range) {
  const Law law = law_of(fit.law);
  const Parameters q = free_parameters(fit);
  const auto n = static_cast<Eigen::Index>(range.pressure.size());
  Eigen::VectorXd e(n);
  for (std::size_t i = 0; i < range.pressure.size(); ++i)
    e[static_cast<Eigen::Index>(i)] =
        law.measured(range.density[i], range.first_density, range.pressure[i]) -
        law.ordinate(q, range.pressure[i]);
  const Eigen::MatrixXd j = derivatives(law, q, range);
  const Eigen::MatrixXd inverse = pseudo_inverse(j.transpose() * j);
  const Eigen::MatrixXd weighted = e.asDiagonal() * j;
  const double r = neighbour_correlation(e), samples = static_cast<double>(n);
  const auto count = static_cast<double>(q.size());
  const double fewer = (1 + r) / (1 - r) * samples / (samples - count);
  const Eigen::MatrixXd covariance = fewer * inverse * (weighted.transpose() * weighted) * inverse;
  FitErrors errors;
  errors.freedom = std::max(1.0, samples * (1 - r) / (1 + r) - count);
  std::size_t k = 0;
  for (const FitParameter& p : fit.parameters) {
    // 1/K has the same relative uncertainty as K.
    const std::size_t of = p.name == "yield_pressure" ? 0 : k++;
    const auto at = static_cast<Eigen::Index>(of);
    errors.standard.push_back(p.is_at_bound ? std::numeric_limits<double>::infinity()
                                            : std::abs(p.value) *
                                                  std::sqrt(std::max(0.0, covariance(at, at))));
  }
  return errors;
}

}  // namespace pulvis
