#include "cli/laboratory/lab_clock.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "scenes/solve/least_squares.hpp"

namespace pulvis::lab {
namespace {

constexpr std::size_t max_places = 300;    // candidates for the start of sliding
constexpr double sure_drift = 3;           // standard uncertainties: a smaller drift is not applied
constexpr std::size_t max_samples = 1500;  // of the press's record used for each candidate

struct Hold {
  std::vector<double> time, displacement;
};

Hold hold_of(const PressRecord& press, const Samples& s) {
  const auto part = [&](const std::vector<double>& all) {
    return std::vector<double>(all.begin() + static_cast<std::ptrdiff_t>(s.begin),
                               all.begin() + static_cast<std::ptrdiff_t>(s.end));
  };
  return {part(press.time), part(press.displacement)};
}

// Residual sum of squares of the punch displacement when the plate starts at `start`.
double unexplained(const Hold& hold, const LoggerRecord& logger, const Sliding& sliding,
                   double start) {
  const std::size_t stride = 1 + hold.time.size() / max_samples;
  const auto count = static_cast<Eigen::Index>((hold.time.size() + stride - 1) / stride);
  Eigen::MatrixXd causes(count, 4);
  Eigen::VectorXd effect(count);
  const double length = hold.time.back() - hold.time.front();
  const double travel = *std::max_element(sliding.distance.begin(), sliding.distance.end());
  for (Eigen::Index row = 0; row < count; ++row) {
    const std::size_t i = static_cast<std::size_t>(row) * stride;
    const double since = hold.time[i] - hold.time.front();
    const double on_logger = hold.time[i] - start + sliding.start.time;
    causes.row(row) << 1, since / length, std::log1p(since),
        interpolated(logger.time, sliding.distance, on_logger) / travel;
    effect[row] = hold.displacement[i] - hold.displacement.front();
  }
  const Eigen::VectorXd fitted = causes * least_squares(causes, effect);
  return (effect - fitted).squaredNorm();
}

double rough_start(const Hold& hold, const LoggerRecord& logger, const Sliding& sliding,
                   double latest) {
  const Samples places = between(hold.time, hold.time.front(), latest);
  const std::size_t stride = 1 + places.count() / max_places;
  double best = hold.time.front(), minimum = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < places.count(); i += stride) {
    const double rest = unexplained(hold, logger, sliding, hold.time[i]);
    if (rest < minimum) {
      minimum = rest;
      best = hold.time[i];
    }
  }
  return best;
}

std::optional<Event> event_in(const Hold& hold, double middle, double window) {
  const auto found = event_near(hold.time, hold.displacement, middle, window);
  return found ? std::optional(found->event) : std::nullopt;
}

// One offset from both events, weighted by their uncertainties. The possible drift between the
// clocks until the end is included: any rate up to the largest is equally likely.
void share_offset(Clocks& clocks, const Event& press_end, const Event& logger_end,
                  double largest_drift) {
  const double at_start = clocks.press_start.time - clocks.logger_start.time;
  const double at_end = press_end.time - logger_end.time;
  const double u_start = clocks.offset_uncertainty;
  const double drifted =
      largest_drift * (logger_end.time - clocks.logger_start.time) / std::sqrt(3.0);
  const double u_end = std::hypot(press_end.uncertainty, logger_end.uncertainty, drifted);
  const double squares = u_start * u_start + u_end * u_end;
  if (!(squares > 0)) return;  // noise-free records: the start is exact
  const double offset = (at_start * u_end * u_end + at_end * u_start * u_start) / squares;
  clocks.press_start.time = clocks.logger_start.time + offset;
  clocks.offset_uncertainty = u_start * u_end / std::sqrt(squares);
}

void find_drift(Clocks& clocks, const PressRecord& press, const Hold& hold, const Sliding& sliding,
                const ClockSpec& spec) {
  if (spec.drift == ClockSpec::Drift::none || !sliding.end) return;
  const double on_logger = sliding.end->time - sliding.start.time;
  const auto end = event_in(hold, clocks.press_start.time + on_logger, spec.window);
  if (!end) return;
  const double on_press = end->time - clocks.press_start.time;
  const double drift = on_press / on_logger - 1;
  clocks.drift_uncertainty =
      std::hypot(std::hypot(end->uncertainty, clocks.press_start.uncertainty),
                 std::hypot(sliding.end->uncertainty, sliding.start.uncertainty)) /
      on_logger;
  if (std::abs(drift) > spec.largest_drift + 4 * clocks.drift_uncertainty)
    refuse(press, "clock",
           fmt::format(
               "sliding lasts {:.5g} s on this clock and {:.5g} s on the logger's, allowed: "
               "records of one test, whose clocks differ by at most {:g} (clock.largest_drift)",
               on_press, on_logger, spec.largest_drift));
  clocks.drift = drift;
  clocks.is_drift_applied = std::abs(drift) > sure_drift * clocks.drift_uncertainty;
  if (!clocks.is_drift_applied) share_offset(clocks, *end, *sliding.end, spec.largest_drift);
}

void find_offset(Clocks& clocks, const PressRecord& press, const LoggerRecord& logger,
                 const Hold& hold, const Sliding& sliding, const ClockSpec& spec) {
  const double lasts = sliding.last_time - sliding.start.time;
  const double latest = hold.time.back() - lasts;
  if (latest < hold.time.front())
    refuse(
        press, "clock",
        fmt::format("the press holds its force for {:.4g} s while the plate slides for {:.4g} s in "
                    "{}, allowed: records of one test, which overlap for all of the sliding",
                    hold.time.back() - hold.time.front(), lasts, logger.file.string()));
  const auto start = event_in(hold, rough_start(hold, logger, sliding, latest), spec.window);
  if (!start)
    refuse(
        press, "clock",
        fmt::format("the punch displacement does not show where sliding starts, allowed: a change "
                    "of its rate within {:g} s (clock.window), or the offset of the clocks as "
                    "run.offset",
                    spec.window));
  clocks.press_start = *start;
  clocks.offset_uncertainty = std::hypot(start->uncertainty, sliding.start.uncertainty);
}

// The end of the loading also lies within the tolerance, and moves the punch much farther than the hold does: this skips
// the part before the force is as close to its level as it typically is.
Samples without_loading(const PressRecord& press, Samples hold) {
  constexpr double usual = 4;  // in units of the median deviation from the median
  const auto median = [](std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
  };
  if (hold.count() == 0) return hold;
  std::vector<double> off(press.force.begin() + static_cast<std::ptrdiff_t>(hold.begin),
                          press.force.begin() + static_cast<std::ptrdiff_t>(hold.end));
  const double level = median(off);
  for (double& force : off) force = std::abs(force - level);
  const double most = usual * median(off);
  for (std::size_t i = 0; i < off.size() && off[i] > most; ++i) ++hold.begin;
  return hold;
}

}  // namespace

Samples find_hold(const PressRecord& press, double tolerance) {
  const double maximum = *std::max_element(press.force.begin(), press.force.end());
  std::vector<double> upper;
  for (const double force : press.force)
    if (force > maximum / 2) upper.push_back(force);
  const auto middle = upper.begin() + static_cast<std::ptrdiff_t>(upper.size() / 2);
  std::nth_element(upper.begin(), middle, upper.end());
  Samples longest, now;
  for (std::size_t i = 0; i < press.force.size(); ++i) {
    if (std::abs(press.force[i] - *middle) > tolerance * *middle) {
      now = {i + 1, i + 1};
      continue;
    }
    now.end = i + 1;
    if (now.count() > longest.count()) longest = now;
  }
  return without_loading(press, longest);
}

Clocks match_clocks(const PressRecord& press, const LoggerRecord& logger, const Sliding& sliding,
                    const ClockSpec& spec, double hold_tolerance, std::optional<double> offset) {
  const Hold hold = hold_of(press, find_hold(press, hold_tolerance));
  Clocks clocks;
  clocks.logger_start = sliding.start;
  clocks.is_given = offset.has_value();
  if (offset)
    clocks.press_start = {sliding.start.time + *offset, sliding.start.uncertainty};
  else
    find_offset(clocks, press, logger, hold, sliding, spec);
  if (!offset) find_drift(clocks, press, hold, sliding, spec);
  clocks.offset = clocks.press_start.time - sliding.start.time;
  const double begin = clocks.press_start.time, end = clocks.press_time(sliding.last_time);
  if (begin < hold.time.front() || end > hold.time.back() + press.interval)
    refuse(press, "clock",
           fmt::format("sliding lies at {:.5g} to {:.5g} s on this clock, allowed: within the time "
                       "that the force is held, {:.5g} to {:.5g} s",
                       begin, end, hold.time.front(), hold.time.back()));
  return clocks;
}

}  // namespace pulvis::lab
