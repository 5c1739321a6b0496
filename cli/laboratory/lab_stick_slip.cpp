#include "cli/laboratory/lab_stick_slip.hpp"

#include "scenes/solve/lab_fit.hpp"
#include "scenes/solve/lab_statistics.hpp"

#include <algorithm>
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

struct Span {  // of samples, with the last one
  std::size_t first = 0, last = 0;
  std::size_t count() const { return last - first + 1; }
};

// From a peak to the next trough: between its two samples with the largest drop.
struct Slip {
  std::size_t peak = 0;
  Span sticks_until;      // last sample before the slip, first after it
  bool is_whole = false;  // a trough follows
};

std::vector<Slip> slips_of(std::span<const double> rest, const std::vector<TurningPoint>& points) {
  std::vector<Slip> slips;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].is_peak) continue;
    const bool is_whole = i + 1 < points.size();
    const std::size_t end = is_whole ? points[i + 1].at : rest.size() - 1;
    std::size_t largest = points[i].at;
    for (std::size_t k = largest; k < end; ++k)
      if (rest[k] - rest[k + 1] > rest[largest] - rest[largest + 1]) largest = k;
    slips.push_back({points[i].at, {largest, largest + 1}, is_whole});
  }
  return slips;
}

Line line_through(std::span<const double> x, std::span<const double> y, const Span& stick) {
  if (stick.count() == 1) return {x[stick.first], y[stick.first], 0, 0, 0, 1};
  return fit_line(x.subspan(stick.first, stick.count()), y.subspan(stick.first, stick.count()));
}

// Without the fifth at either end, where the curve may still be slipping.
Span inner_part(const Span& stick) {
  const std::size_t left_out = stick.count() < 5 ? 0 : std::max<std::size_t>(1, stick.count() / 5);
  return {stick.first + left_out, stick.last - left_out};
}

// The sticks before, between and after the slips; samples in a slip belong to none.
class Sticks {
 public:
  Sticks(std::span<const double> x, std::span<const double> rest, std::vector<Slip>& slips,
         std::size_t begin)
      : x_(x), rest_(rest), slips_(slips), begin_(begin) {
    fit_lines(true);
    const double off = deviation();
    for (std::size_t i = 0; i < slips_.size(); ++i) {
      Span& slip = slips_[i].sticks_until;
      const Span before = stick(i), after = stick(i + 1);
      const double share = off_the_line * (at_slip(lines_[i], i) - at_slip(lines_[i + 1], i));
      const double least = std::max(noise_deviations * off, share);
      const auto is_off = [&](const Line& line, std::size_t k) {
        return std::abs(rest_[k] - line.at(x_[k])) > least;
      };
      while (slip.first > before.first + before.count() / 2 && is_off(lines_[i], slip.first))
        --slip.first;
      while (slip.last < after.last - after.count() / 2 && is_off(lines_[i + 1], slip.last))
        ++slip.last;
    }
    fit_lines(false);
  }

  // Of `values`, which need not be those that the slips were found in.
  double drop(std::span<const double> values, std::size_t slip) const {
    const Span& at = slips_[slip].sticks_until;
    const double begins = 0.5 * (x_[at.first] + x_[at.first + 1]);
    const double ends = 0.5 * (x_[at.last - 1] + x_[at.last]);
    return line_through(x_, values, stick(slip)).at(begins) -
           line_through(x_, values, stick(slip + 1)).at(ends);
  }

  // Mean rise from one sample to the next.
  double climb() const {
    double sum = 0, samples = 0;
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      const Span s = stick(i);
      if (s.count() < 2) continue;
      sum += lines_[i].slope * (x_[s.last] - x_[s.first]);
      samples += static_cast<double>(s.count() - 1);
    }
    return samples > 0 ? sum / samples : 0;
  }

 private:
  static constexpr double noise_deviations = 4, off_the_line = 0.1;

  Span stick(std::size_t i) const {
    return {i == 0 ? begin_ : slips_[i - 1].sticks_until.last,
            i == slips_.size() ? rest_.size() - 1 : slips_[i].sticks_until.first};
  }
  void fit_lines(bool of_middles) {
    lines_.clear();
    for (std::size_t i = 0; i <= slips_.size(); ++i)
      lines_.push_back(line_through(x_, rest_, of_middles ? inner_part(stick(i)) : stick(i)));
  }
  double at_slip(const Line& line, std::size_t i) const {
    return line.at(x_[slips_[i].sticks_until.first]);
  }
  double deviation() const {
    double squares = 0, freedom = 0;
    for (const Line& line : lines_) {
      squares += line.residual;
      freedom += line.count > 2 ? static_cast<double>(line.count - 2) : 0;
    }
    return freedom > 0 ? std::sqrt(squares / freedom) : 0;
  }

  std::span<const double> x_, rest_;
  std::vector<Slip>& slips_;
  std::size_t begin_;
  std::vector<Line> lines_;
};

struct SlipFigures {
  std::vector<double> falls, forces, distances, times;  // the last two from peak to peak
};

SlipFigures figures_of(const FrictionCurve& curve, std::span<const double> rest,
                       const std::vector<Slip>& slips, const Sticks& sticks) {
  SlipFigures figures;
  for (std::size_t i = 0; i < slips.size(); ++i) {
    if (i > 0) {
      const std::size_t from = slips[i - 1].peak, to = slips[i].peak;
      figures.distances.push_back(curve.distance[to] - curve.distance[from]);
      figures.times.push_back(curve.time[to] - curve.time[from]);
    }
    if (!slips[i].is_whole) continue;
    figures.falls.push_back(sticks.drop(rest, i));
    figures.forces.push_back(sticks.drop(curve.force, i));
  }
  return figures;
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
  std::vector<Slip> slips = slips_of(rest, points);
  if (slips.size() < fewest_slips || points.size() < 2 * fewest_slips) return std::nullopt;
  // A trough that comes first is the end of a slip that the record does not show.
  const Sticks sticks(curve.distance, rest, slips, points.front().is_peak ? 0 : points.front().at);
  const SlipFigures figures = figures_of(curve, rest, slips, sticks);
  if (figures.falls.size() < fewest_slips) return std::nullopt;
  const Sample falls = sample_of(figures.falls), distances = sample_of(figures.distances);
  const double spectral = spectral_period(curve.distance, rest);
  const bool is_regular = distances.deviation < max_scatter * distances.mean &&
                          std::abs(spectral - distances.mean) < spectral_match * distances.mean;
  if (!is_regular) return std::nullopt;
  return StickSlip{figures.falls.size(),
                   falls.mean,
                   falls.deviation,
                   sticks.climb(),
                   sample_of(figures.forces).mean,
                   distances.mean,
                   distances.deviation,
                   sample_of(figures.times).mean,
                   spectral};
}

}  // namespace pulvis::lab
