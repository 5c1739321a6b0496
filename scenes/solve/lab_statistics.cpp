#include "scenes/solve/lab_statistics.hpp"

#include <cmath>
#include <numbers>

namespace pulvis::lab {
namespace {

// A&S 26.7.3 and 26.7.4 with theta = atan(t / sqrt(degrees)).
double probability_at(double theta, int degrees) {
  const double c2 = std::cos(theta) * std::cos(theta);
  const bool is_odd = degrees % 2 == 1;
  double term = is_odd ? std::cos(theta) : 1, sum = degrees > 1 ? term : 0;
  for (int k = is_odd ? 3 : 2; k <= degrees - 2; k += 2) {
    term *= c2 * (k - 1) / k;
    sum += term;
  }
  const double inner = std::sin(theta) * sum;
  return is_odd ? 2 / std::numbers::pi * (theta + inner) : inner;
}

}  // namespace

Sample sample_of(std::span<const double> values) {
  Sample sample{values.size(), 0, 0};
  const auto n = static_cast<double>(values.size());
  for (const double value : values) sample.mean += value / n;
  double squares = 0;
  for (const double value : values) squares += (value - sample.mean) * (value - sample.mean);
  if (values.size() > 1) sample.deviation = std::sqrt(squares / (n - 1));
  return sample;
}

double student_probability(double t, int degrees) {
  return probability_at(std::atan(t / std::sqrt(degrees)), degrees);
}

double student_quantile(double confidence, int degrees) {
  double low = 0, high = std::numbers::pi / 2;  // of theta
  for (int halving = 0; halving < 60; ++halving) {
    const double middle = (low + high) / 2;
    (probability_at(middle, degrees) < confidence ? low : high) = middle;
  }
  return std::sqrt(degrees) * std::tan((low + high) / 2);
}

std::optional<double> half_width(const Sample& sample, double confidence) {
  if (sample.count < 2) return std::nullopt;
  const double t = student_quantile(confidence, static_cast<int>(sample.count) - 1);
  return t * sample.deviation / std::sqrt(static_cast<double>(sample.count));
}

}  // namespace pulvis::lab
