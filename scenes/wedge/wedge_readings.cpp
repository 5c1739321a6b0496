#include "scenes/wedge/wedge_readings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <stdexcept>

#include "engine/portable_math.hpp"
#include "scenes/solve/lab_fit.hpp"

namespace pulvis::wedge {
namespace {

// Through the loops of several loads; `of` and `error_of` select the fitted value.
template <class Of, class ErrorOf>
Fit line_through(const std::vector<Loop>& loops, const Of& of, const ErrorOf& error_of) {
  std::vector<double> load, value;
  for (const Loop& loop : loops) load.push_back(loop.load), value.push_back(of(loop));
  const lab::Line line = lab::fit_line(load, value);
  const auto n = static_cast<double>(loops.size());
  Fit fit{{line.slope, {}}, {line.at(0), {}}, {line.value, {}}, line.middle};
  double slope2 = 0, zero2 = 0, middle2 = 0;
  bool known = true;
  for (const Loop& loop : loops) {
    const std::optional<double> error = error_of(loop);
    known = known && error;
    const double on_slope = (loop.load - line.middle) / line.spread;
    const double on_zero = 1 / n - line.middle * on_slope;
    slope2 += squared(on_slope * error.value_or(0));
    zero2 += squared(on_zero * error.value_or(0));
    middle2 += squared(error.value_or(0) / n);
  }
  if (loops.size() > 2) {
    const double scatter2 = line.residual / (n - 2);
    slope2 = std::max(known ? slope2 : 0, scatter2 / line.spread);
    zero2 =
        std::max(known ? zero2 : 0, scatter2 * (1 / n + line.middle * line.middle / line.spread));
    middle2 = std::max(known ? middle2 : 0, scatter2 / n);
    known = true;
  }
  if (!known) return fit;
  fit.slope.error = std::sqrt(slope2);
  fit.zero.error = std::sqrt(zero2);
  fit.middle.error = std::sqrt(middle2);
  return fit;
}

// Loops at one load: their mean over the load.
template <class Of, class ErrorOf>
Value mean_by_load(const std::vector<Loop>& loops, const Of& of, const ErrorOf& error_of) {
  const auto n = static_cast<double>(loops.size());
  double sum = 0, squares = 0, error2 = 0;
  bool known = true;
  for (const Loop& loop : loops) {
    const double value = of(loop) / loop.load;
    sum += value;
    squares += value * value;
    known = known && error_of(loop);
    error2 += squared(error_of(loop).value_or(0) / loop.load / n);
  }
  const double mean = sum / n;
  if (loops.size() > 2) {
    const double scatter2 = std::max(0.0, squares / n - mean * mean) / (n - 1);
    error2 = std::max(known ? error2 : 0, scatter2);
    known = true;
  }
  return {mean, known ? std::optional(std::sqrt(error2)) : std::nullopt};
}

Reading reading_of(const std::vector<Loop>& loops) {
  Reading reading;
  Facet& facet = reading.facet;
  facet.slope = loops.front().slope;
  facet.loops = static_cast<int>(loops.size());
  std::set<double> loads;
  for (const Loop& loop : loops) loads.insert(loop.load);
  facet.loads = static_cast<int>(loads.size());
  const auto width = [](const Loop& loop) { return loop.half_width; };
  const auto width_error = [](const Loop& loop) { return loop.half_width_error; };
  const auto offset = [](const Loop& loop) { return loop.offset; };
  const auto offset_error = [](const Loop& loop) { return loop.offset_error; };
  if (facet.loads == 1) {
    if (loops.front().load == 0)
      throw std::runtime_error(
          "a facet was measured at zero load only, allowed: loads other than 0");
    facet.half_width = mean_by_load(loops, width, width_error);
    facet.offset = mean_by_load(loops, offset, offset_error);
    reading.load = loops.front().load;
    return reading;
  }
  const Fit w = line_through(loops, width, width_error);
  facet.half_width = w.slope;
  reading.offset = line_through(loops, offset, offset_error);
  facet.offset = reading.offset.slope;
  const double adhesion = w.zero.value / (w.slope.value * portable::cos(facet.slope));
  facet.adhesion = Value{adhesion, {}};
  if (w.zero.error && w.slope.error)
    facet.adhesion->error =
        portable::hypot(*w.zero.error / (w.slope.value * portable::cos(facet.slope)),
                        adhesion * *w.slope.error / w.slope.value);
  return reading;
}

}  // namespace

std::vector<Reading> readings_of(const std::vector<Loop>& loops) {
  std::map<double, std::vector<Loop>> by_slope;
  for (const Loop& loop : loops) by_slope[loop.slope].push_back(loop);
  std::vector<Reading> readings;
  for (const auto& [slope, own] : by_slope) {
    if (!(std::abs(slope) < std::numbers::pi / 2))
      throw std::runtime_error(fmt::format("a slope of {:g} deg, allowed: between -90 and 90 deg",
                                           slope * 180 / std::numbers::pi));
    readings.push_back(reading_of(own));
    if (readings.back().facet.half_width.value == 0)
      throw std::runtime_error(fmt::format("the loops on {:g} deg have no width, allowed: friction",
                                           slope * 180 / std::numbers::pi));
  }
  return readings;
}

}  // namespace pulvis::wedge
