// Mean, standard deviation and confidence interval over a few runs.
//
// Source   Student (1908); the distribution for integer degrees of freedom in closed form:
//          Abramowitz & Stegun (1972), 26.7.3 and 26.7.4
// Symbols  s standard deviation with n - 1; half width of the interval t s / sqrt(n), where t leaves
//          (1 - confidence)/2 on either side of the distribution with n - 1 degrees of freedom
#pragma once

#include <cstddef>
#include <optional>
#include <span>

namespace pulvis::lab {

struct Sample {
  std::size_t count = 0;
  double mean = 0;
  double deviation = 0;  // s; 0 for one value
};

Sample sample_of(std::span<const double> values);

// Probability that |T| <= t.
double student_probability(double t, int degrees);

// The t whose probability is `confidence`.
double student_quantile(double confidence, int degrees);

// Half width of the confidence interval of the mean; empty for fewer than two values.
std::optional<double> half_width(const Sample& sample, double confidence);

}  // namespace pulvis::lab
