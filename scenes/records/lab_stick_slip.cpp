#include "scenes/records/lab_stick_slip.hpp"

#include "scenes/records/lab_statistics.hpp"
#include "scenes/solve/lab_fit.hpp"

#include <cmath>
#include <numbers>

namespace pulvis::lab {
namespace {

constexpr double noise_multiple = 6;
constexpr double smallest_share = 0.005;  // of the mean coefficient
constexpr std::size_t fewest_slips = 3;
constexpr double max_scatter = 0.5;      // of the period
constexpr double spectral_match = 0.25;  // of the period

// Power at one frequency, with the sine and cosine sums made orthogonal by the shift tau.
double lomb_power(std::span<const double> x, std::span<const double> y, double omega) {
  double sine2 = 0, cosine2 = 0;
  for (const double at : x) {
    sine2 += std::sin(2 * omega * at);
    cosine2 += std::cos(2 * omega * at);
  }
  const double tau = std::atan2(sine2, cosine2) / (2 * omega);
  double yc = 0, ys = 0, cc = 0, ss = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double c = std::cos(omega * (x[i] - tau)), s = std::sin(omega * (x[i] - tau));
    yc += y[i] * c;
    ys += y[i] * s;
    cc += c * c;
    ss += s * s;
  }
  return (cc > 0 ? yc * yc / cc : 0) + (ss > 0 ? ys * ys / ss : 0);
}

struct Slips {
  std::vector<double> falls, forces, distances, times;  // the last two from peak to peak
};

Slips slips_of(const FrictionCurve& curve, std::span<const double> rest,
               const std::vector<TurningPoint>& points) {
  Slips slips;
  const TurningPoint* last_peak = nullptr;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].is_peak) continue;
    const std::size_t peak = points[i].at;
    if (last_peak != nullptr) {
      slips.distances.push_back(curve.distance[peak] - curve.distance[last_peak->at]);
      slips.times.push_back(curve.time[peak] - curve.time[last_peak->at]);
    }
    last_peak = &points[i];
    if (i + 1 == points.size()) continue;
    const std::size_t trough = points[i + 1].at;
    slips.falls.push_back(rest[peak] - rest[trough]);
    slips.forces.push_back(curve.force[peak] - curve.force[trough]);
  }
  return slips;
}

// Mean rise from one sample to the next between a trough and the next peak.
double climb(std::span<const double> rest, const std::vector<TurningPoint>& points) {
  double sum = 0, samples = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (!points[i].is_peak) continue;
    sum += rest[points[i].at] - rest[points[i - 1].at];
    samples += static_cast<double>(points[i].at - points[i - 1].at);
  }
  return samples > 0 ? sum / samples : 0;
}

}  // namespace

std::vector<TurningPoint> turning_points(std::span<const double> values, double threshold) {
  std::vector<TurningPoint> points;
  std::size_t high = 0, low = 0;
  bool seeks_peak = true, seeks_trough = true;  // both until the first one is found
  for (std::size_t i = 1; i < values.size(); ++i) {
    if (values[i] > values[high]) high = i;
    if (values[i] < values[low]) low = i;
    if (seeks_peak && values[high] - values[i] > threshold) {
      points.push_back({high, true});
      seeks_peak = false;
      seeks_trough = true;
      low = i;
    } else if (seeks_trough && values[i] - values[low] > threshold) {
      points.push_back({low, false});
      seeks_peak = true;
      seeks_trough = false;
      high = i;
    }
  }
  return points;
}

double spectral_period(std::span<const double> x, std::span<const double> y) {
  constexpr double steps_in_a_line = 5;  // frequencies tried within the width of one line
  const double span = x.back() - x.front();
  const double step = 1 / (steps_in_a_line * span), interval = span / static_cast<double>(x.size());
  double best = 2 / span, maximum = 0;
  for (double f = 2 / span; f <= 0.5 / interval; f += step) {
    const double power = lomb_power(x, y, 2 * std::numbers::pi * f);
    if (power > maximum) {
      maximum = power;
      best = f;
    }
  }
  return 1 / best;
}

std::optional<StickSlip> find_stick_slip(const FrictionCurve& curve, double noise) {
  if (curve.distance.size() < 10) return std::nullopt;
  const Line line = fit_line(curve.distance, curve.coefficient);
  std::vector<double> rest;
  for (std::size_t i = 0; i < curve.distance.size(); ++i)
    rest.push_back(curve.coefficient[i] - line.at(curve.distance[i]));
  const double threshold = std::max(noise_multiple * noise, smallest_share * std::abs(line.value));
  const std::vector<TurningPoint> points = turning_points(rest, threshold);
  const Slips slips = slips_of(curve, rest, points);
  if (slips.falls.size() < fewest_slips || slips.distances.size() + 1 < fewest_slips)
    return std::nullopt;
  const Sample falls = sample_of(slips.falls), distances = sample_of(slips.distances);
  const double spectral = spectral_period(curve.distance, rest);
  const bool is_regular = distances.deviation < max_scatter * distances.mean &&
                          std::abs(spectral - distances.mean) < spectral_match * distances.mean;
  if (!is_regular) return std::nullopt;
  return StickSlip{slips.falls.size(),
                   falls.mean,
                   falls.deviation,
                   climb(rest, points),
                   sample_of(slips.forces).mean,
                   distances.mean,
                   distances.deviation,
                   sample_of(slips.times).mean,
                   spectral};
}

}  // namespace pulvis::lab
