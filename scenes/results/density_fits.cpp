#include "scenes/results/density_fits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "scenes/results/cooper_eaton.hpp"

namespace pulvis {
namespace {

constexpr double allowed_fall =
    1e-6;  // of the density between samples: round-off of tool positions

struct Line {
  double slope = 0, intercept = 0;
};

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

Line straight_line(const std::vector<double>& x, const std::vector<double>& y) {
  const double mx = mean(x), my = mean(y);
  double xx = 0, xy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mx) * (x[i] - mx);
    xy += (x[i] - mx) * (y[i] - my);
  }
  const double slope = xy / xx;
  return {slope, my - slope * mx};
}

double sum_of_squares(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum;
}

// How well `law` fits the fitted ordinate, and `densities` the measured ones.
void judge(DensityFit& fit, const FitRange& range, const std::vector<double>& ordinate,
           const std::vector<double>& law, std::vector<double> densities) {
  const double count = static_cast<double>(ordinate.size());
  const double residual = sum_of_squares(ordinate, law);
  const std::vector<double> level(ordinate.size(), mean(ordinate));
  fit.rms = std::sqrt(residual / count);
  fit.r_squared = 1 - residual / sum_of_squares(ordinate, level);
  fit.rms_density = std::sqrt(sum_of_squares(range.density, densities) / count);
  fit.densities = std::move(densities);
}

template <class Function>
std::vector<double> each(const std::vector<double>& values, const Function& function) {
  std::vector<double> out(values.size());
  std::ranges::transform(values, out.begin(), function);
  return out;
}

// If density decreases before its maximum is reached, this is not a single loading.
std::string falls(std::span<const double> density, std::size_t last) {
  for (std::size_t i = 1; i <= last; ++i)
    if (density[i] < density[i - 1] - allowed_fall)
      return fmt::format(
          "the relative density falls from {:.6g} to {:.6g} before its largest value: not a single "
          "loading",
          density[i - 1], density[i]);
  return "";
}

std::string too_little(double change) {
  if (change >= min_density_change) return "";
  return fmt::format("the relative density changes by {:.3g}, at least {:g} is needed", change,
                     min_density_change);
}

std::string unusable(const FitRange& range) {
  if (range.density.size() < fewest_fit_samples)
    return fmt::format("{} samples under pressure, at least {} are needed", range.density.size(),
                       fewest_fit_samples);
  const std::string little = too_little(range.density.back() - range.density.front());
  if (!little.empty()) return little;
  const auto [low, high] = std::ranges::minmax(range.pressure);
  if (!(high > low)) return "the pressure is constant";
  return "";
}

}  // namespace

FitRange range_between(double first_density, std::span<const double> density,
                       std::span<const double> pressure, double low, double high) {
  FitRange range;
  range.first_density = first_density;
  for (std::size_t i = 0; i < density.size(); ++i) {
    if (!(pressure[i] > 0) || pressure[i] < low || pressure[i] > high || density[i] >= 1) continue;
    range.density.push_back(density[i]);
    range.pressure.push_back(pressure[i]);
  }
  range.unusable = unusable(range);
  return range;
}

FitRange fit_range(std::span<const double> density, std::span<const double> pressure) {
  FitRange range;
  const auto finite = [](double value) { return std::isfinite(value); };
  if (density.size() != pressure.size() || density.empty()) {
    range.unusable = "there are no samples";
    return range;
  }
  if (!std::ranges::all_of(density, finite) || !std::ranges::all_of(pressure, finite)) {
    range.unusable = "a sample is not finite";
    return range;
  }
  range.first_density = density.front();
  const auto last = static_cast<std::size_t>(std::ranges::max_element(density) - density.begin());
  range.unusable = falls(density, last);
  if (range.unusable.empty()) range.unusable = too_little(density[last] - density.front());
  if (!range.unusable.empty()) return range;
  const double maximum = std::ranges::max(pressure.first(last + 1));
  return range_between(density.front(), density.first(last + 1), pressure.first(last + 1),
                       min_pressure_share * maximum, maximum);
}

DensityFit fit_heckel(const FitRange& range) {
  DensityFit fit{"heckel", range.unusable, {}, 0, "-", 0, 0, {}};
  if (!fit.not_fitted.empty()) return fit;
  const auto y = each(range.density, [](double d) { return -std::log(1 - d); });
  const Line line = straight_line(range.pressure, y);
  if (!(line.slope > 0)) {
    fit.not_fitted =
        fmt::format("the slope K is {:.3g} 1/Pa: it gives no yield pressure", line.slope);
    return fit;
  }
  fit.parameters = {{"K", "1/Pa", line.slope},
                    {"A", "-", line.intercept},
                    {"yield_pressure", "Pa", 1 / line.slope}};
  const auto law = each(range.pressure, [&](double p) { return line.slope * p + line.intercept; });
  judge(fit, range, y, law, each(law, [](double value) { return 1 - std::exp(-value); }));
  return fit;
}

DensityFit fit_kawakita(const FitRange& range) {
  DensityFit fit{"kawakita", range.unusable, {}, 0, "Pa", 0, 0, {}};
  if (!fit.not_fitted.empty()) return fit;
  const double d0 = range.first_density;
  std::vector<double> y(range.density.size());
  for (std::size_t i = 0; i < y.size(); ++i) {
    const double c = 1 - d0 / range.density[i];
    if (!(c > 0)) {
      fit.not_fitted = fmt::format("there is pressure at the initial density {:.6g}", d0);
      return fit;
    }
    y[i] = range.pressure[i] / c;
  }
  const Line line = straight_line(range.pressure, y);
  if (!(line.slope > 0) || !(line.intercept > 0)) {
    fit.not_fitted = fmt::format(
        "P/C = {:.4g} P + {:.4g} Pa: a and b are meaningful only if both numbers are positive",
        line.slope, line.intercept);
    return fit;
  }
  const double a = 1 / line.slope, b = line.slope / line.intercept;
  fit.parameters = {{"a", "-", a}, {"b", "1/Pa", b}};
  const auto law = each(range.pressure, [&](double p) { return line.slope * p + line.intercept; });
  judge(fit, range, y, law,
        each(range.pressure, [&](double p) { return d0 / (1 - a * b * p / (1 + b * p)); }));
  return fit;
}

DensityFit fit_cooper_eaton(const FitRange& range) {
  DensityFit fit{"cooper_eaton", range.unusable, {}, 0, "-", 0, 0, {}};
  if (!fit.not_fitted.empty()) return fit;
  const double d0 = range.first_density;
  const auto y = each(range.density, [&](double d) { return (1 - d0 / d) / (1 - d0); });
  const CooperEaton found = find_cooper_eaton(range.pressure, y);
  if (found.terms == 0) {
    fit.not_fitted = "no sum of terms with a > 0 and k > 0 fits the curve";
    return fit;
  }
  fit.parameters = {{"a1", "-", found.a[0]}, {"k1", "Pa", found.k[0], found.is_k_at_bound[0]}};
  if (found.terms == 2) {
    fit.parameters.push_back({"a2", "-", found.a[1]});
    fit.parameters.push_back({"k2", "Pa", found.k[1], found.is_k_at_bound[1]});
  }
  const auto law = each(range.pressure, [&](double p) { return found.at(p); });
  judge(fit, range, y, law, each(law, [&](double v) { return d0 / (1 - v * (1 - d0)); }));
  return fit;
}

std::vector<DensityFit> fit_all(const FitRange& range) {
  return {fit_heckel(range), fit_kawakita(range), fit_cooper_eaton(range)};
}

}  // namespace pulvis
