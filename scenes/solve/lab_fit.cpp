#include "scenes/solve/lab_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pulvis::lab {
namespace {

constexpr std::size_t fewest_on_a_side = 5;

double crossing(const Line& a, const Line& b) {
  // a.at(t) = b.at(t), solved for t - a.middle
  const double difference = b.at(a.middle) - a.value;
  return a.middle + difference / (a.slope - b.slope);
}

Bend bend_at(const Line& before, const Line& after) {
  Bend bend{before, after};
  bend.time = crossing(before, after);
  const auto degrees = static_cast<double>(before.count + after.count - 4);
  const double variance = (before.residual + after.residual) / degrees;
  const double from_before = bend.time - before.middle, from_after = bend.time - after.middle;
  const double leverage =
      1.0 / static_cast<double>(before.count) + 1.0 / static_cast<double>(after.count) +
      from_before * from_before / before.spread + from_after * from_after / after.spread;
  bend.noise = std::sqrt(variance);
  bend.uncertainty = bend.noise * std::sqrt(leverage) / std::abs(before.slope - after.slope);
  bend.slope_uncertainty = bend.noise * std::sqrt(1 / before.spread + 1 / after.spread);
  return bend;
}

}  // namespace

Line fit_line(std::span<const double> t, std::span<const double> y) {
  Line line;
  line.count = t.size();
  const auto n = static_cast<double>(t.size());
  for (std::size_t i = 0; i < t.size(); ++i) {
    line.middle += (t[i] - t[0]) / n;  // relative to the first: clock times may be large
    line.value += y[i] / n;
  }
  line.middle += t[0];
  double product = 0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const double from_middle = t[i] - line.middle;
    line.spread += from_middle * from_middle;
    product += from_middle * (y[i] - line.value);
  }
  line.slope = product / line.spread;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const double rest = y[i] - line.at(t[i]);
    line.residual += rest * rest;
  }
  return line;
}

bool Bend::is_significant() const {
  const double difference = std::abs(after.slope - before.slope);
  const double size = std::max(std::abs(after.slope), std::abs(before.slope));
  return difference > 5 * slope_uncertainty && difference > 1e-9 * size;
}

std::optional<Bend> find_bend(std::span<const double> t, std::span<const double> y) {
  std::optional<Bend> best;
  double minimum = std::numeric_limits<double>::infinity();
  for (std::size_t split = fewest_on_a_side; split + fewest_on_a_side <= t.size(); ++split) {
    const Line before = fit_line(t.first(split), y.first(split));
    const Line after = fit_line(t.subspan(split), y.subspan(split));
    const double residual = before.residual + after.residual;
    if (!(residual < minimum) || before.slope == after.slope) continue;
    const Bend bend = bend_at(before, after);
    if (bend.time < t.front() || bend.time > t.back()) continue;
    minimum = residual;
    best = bend;
  }
  return best;
}

std::optional<BendEvent> event_near(std::span<const double> t, std::span<const double> y,
                                    double middle, double window) {
  const auto look = [&](double at, double reach) {
    const Samples s = between(t, at - reach, at + reach);
    std::optional<Bend> bend =
        find_bend(t.subspan(s.begin, s.count()), y.subspan(s.begin, s.count()));
    if (bend && !bend->is_significant()) bend.reset();
    return bend;
  };
  const auto first = look(middle, window);
  if (!first) return std::nullopt;
  const auto bend = look(first->time, window);  // with the intersection in the middle of the window
  if (!bend) return std::nullopt;
  const auto closer = look(bend->time, window / 2);
  const double shift = closer ? closer->time - bend->time : 0;
  return BendEvent{*bend, {bend->time, std::hypot(bend->uncertainty, shift)}};
}

double inflation_of(std::span<const double> rest) {
  double squares = 0, neighbours = 0;
  for (std::size_t i = 0; i < rest.size(); ++i) {
    squares += rest[i] * rest[i];
    if (i > 0) neighbours += rest[i] * rest[i - 1];
  }
  const double r = squares > 0 ? std::clamp(neighbours / squares, 0.0, 0.99) : 0;
  return std::sqrt((1 + r) / (1 - r));
}

Mean correlated_mean(std::span<const double> y) {
  const auto n = static_cast<double>(y.size());
  double mean = 0, squares = 0;
  for (const double v : y) mean += v / n;
  std::vector<double> rest(y.begin(), y.end());
  for (double& v : rest) v -= mean, squares += v * v;
  return {mean, std::sqrt(squares / (n - 1) / n) * inflation_of(rest)};
}

double slope_error(const Line& line, double inflation) {
  const auto freedom = static_cast<double>(line.count - 2);
  return inflation * std::sqrt(line.residual / freedom / line.spread);
}

double value_error(const Line& line, double t, double inflation) {
  const auto n = static_cast<double>(line.count);
  const double from = t - line.middle;
  return inflation * std::sqrt(line.residual / (n - 2) * (1 / n + from * from / line.spread));
}

Samples between(std::span<const double> t, double low, double high) {
  const auto begin = std::lower_bound(t.begin(), t.end(), low);
  const auto end = std::upper_bound(begin, t.end(), high);
  return {static_cast<std::size_t>(begin - t.begin()), static_cast<std::size_t>(end - t.begin())};
}

double interpolated(std::span<const double> t, std::span<const double> y, double at) {
  if (at <= t.front()) return y.front();
  if (at >= t.back()) return y.back();
  const auto above = static_cast<std::size_t>(std::upper_bound(t.begin(), t.end(), at) - t.begin());
  const double share = (at - t[above - 1]) / (t[above] - t[above - 1]);
  return y[above - 1] + share * (y[above] - y[above - 1]);
}

}  // namespace pulvis::lab
