#include "cli/campaigns/study/analysis/study_weibull.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

namespace pulvis {
namespace {

constexpr double outside = 0.05;  // probability beyond each limit

// ln s of one sample, relative to its largest, so that no power overflows.
struct Logarithms {
  std::vector<double> below;  // <= 0
  double largest = 0;
  double mean = 0;  // of `below`
};

Logarithms logarithms(const std::vector<double>& strengths) {
  Logarithms logs;
  logs.largest = std::log(std::ranges::max(strengths));
  for (const double strength : strengths) logs.below.push_back(std::log(strength) - logs.largest);
  for (const double x : logs.below) logs.mean += x / static_cast<double>(logs.below.size());
  return logs;
}

struct Slope {
  double value = 0, derivative = 0;
};

// Derivative of the log-likelihood, with the best scales substituted.
Slope likelihood_slope(const std::vector<Logarithms>& samples, double modulus) {
  Slope slope;
  for (const Logarithms& logs : samples) {
    double w = 0, wx = 0, wxx = 0;
    for (const double x : logs.below) {
      const double weight = std::exp(modulus * x);
      w += weight;
      wx += weight * x;
      wxx += weight * x * x;
    }
    const double n = static_cast<double>(logs.below.size()), at = wx / w;
    slope.value += n * (1 / modulus + logs.mean - at);
    slope.derivative -= n * (1 / (modulus * modulus) + wxx / w - at * at);
  }
  return slope;
}

// Newton's method, bracketed on both sides of the root.
double likeliest_modulus(const std::vector<Logarithms>& samples) {
  constexpr int most = 200;
  constexpr double near = 1e-13;
  double low = 0, high = 1;
  while (likelihood_slope(samples, high).value > 0) low = high, high *= 2;
  double modulus = 0.5 * (low + high);
  for (int i = 0; i < most; ++i) {
    const Slope slope = likelihood_slope(samples, modulus);
    (slope.value > 0 ? low : high) = modulus;
    double next = modulus - slope.value / slope.derivative;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    const bool done = std::abs(next - modulus) <= near * modulus;
    modulus = next;
    if (done) break;
  }
  return modulus;
}

double log_scale(const Logarithms& logs, double modulus) {
  double sum = 0;
  for (const double x : logs.below) sum += std::exp(modulus * x);
  return logs.largest + std::log(sum / static_cast<double>(logs.below.size())) / modulus;
}

// Random strengths of modulus and scale 1, as many as in `like`. The engine is portable: same numbers.
std::vector<Logarithms> drawn(const std::vector<Logarithms>& like, std::mt19937_64& engine) {
  std::vector<Logarithms> samples;
  for (const Logarithms& sample : like) {
    std::vector<double> strengths(sample.below.size());
    for (double& strength : strengths)
      strength = -std::log((static_cast<double>(engine() >> 11U) + 0.5) * 0x1p-53);
    samples.push_back(logarithms(strengths));
  }
  return samples;
}

double quantile(std::vector<double> values, double share) {
  const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::ranges::nth_element(values, values.begin() + at);
  return values[static_cast<std::size_t>(at)];
}

struct Pivots {
  std::vector<double> modulus;             // modulus^/modulus
  std::vector<std::vector<double>> scale;  // [sample] modulus^ ln(scale^/scale)
};

Pivots drawn_pivots(const std::vector<Logarithms>& like, int draws) {
  Pivots pivots;
  pivots.scale.resize(like.size());
  std::mt19937_64 engine(1);
  for (int draw = 0; draw < draws; ++draw) {
    const std::vector<Logarithms> samples = drawn(like, engine);
    const double modulus = likeliest_modulus(samples);
    pivots.modulus.push_back(modulus);
    for (std::size_t i = 0; i < samples.size(); ++i)
      pivots.scale[i].push_back(modulus * log_scale(samples[i], modulus));
  }
  return pivots;
}

// The slope of the regression line through one y per size is the sum of y with these weights.
std::vector<double> slope_weights(const std::vector<double>& sizes) {
  std::vector<double> weights;
  double mean = 0, square = 0;
  for (const double size : sizes) mean += std::log(size) / static_cast<double>(sizes.size());
  for (const double size : sizes) weights.push_back(std::log(size) - mean);
  for (const double weight : weights) square += weight * weight;
  for (double& weight : weights) weight /= square;
  return weights;
}

double estimated_exponent(const std::vector<double>& weights, const std::vector<Estimate>& scales) {
  double sum = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) sum += weights[i] * std::log(scales[i].value);
  return sum;
}

void limit_exponent(WeibullFit& fit, const std::vector<double>& weights, const Pivots& pivots) {
  std::vector<double> sums(pivots.modulus.size(), 0);
  for (std::size_t i = 0; i < weights.size(); ++i)
    for (std::size_t draw = 0; draw < sums.size(); ++draw)
      sums[draw] += weights[i] * pivots.scale[i][draw];
  fit.exponent.low = fit.exponent.value - quantile(sums, 1 - outside) / fit.modulus.value;
  fit.exponent.high = fit.exponent.value - quantile(sums, outside) / fit.modulus.value;
}

}  // namespace

WeibullFit fit_weibull(const std::vector<std::vector<double>>& samples, int draws,
                       const std::vector<double>& sizes) {
  std::vector<Logarithms> logs;
  for (const std::vector<double>& strengths : samples) logs.push_back(logarithms(strengths));
  const double modulus = likeliest_modulus(logs);
  WeibullFit fit;
  fit.modulus.value = modulus;
  for (const Logarithms& one : logs) fit.scales.push_back({std::exp(log_scale(one, modulus))});
  const std::vector<double> weights = slope_weights(sizes);
  fit.exponent.value = estimated_exponent(weights, fit.scales);
  if (draws == 0) return fit;
  const Pivots pivots = drawn_pivots(logs, draws);
  double mean = 0;
  for (const double value : pivots.modulus) mean += value / draws;
  fit.unbiased_modulus = modulus / mean;
  fit.modulus.low = modulus / quantile(pivots.modulus, 1 - outside);
  fit.modulus.high = modulus / quantile(pivots.modulus, outside);
  for (std::size_t i = 0; i < logs.size(); ++i) {
    Estimate& scale = fit.scales[i];
    scale.low = scale.value * std::exp(-quantile(pivots.scale[i], 1 - outside) / modulus);
    scale.high = scale.value * std::exp(-quantile(pivots.scale[i], outside) / modulus);
  }
  limit_exponent(fit, weights, pivots);
  return fit;
}

}  // namespace pulvis
