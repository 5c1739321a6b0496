#include "scenes/lab_clock.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

namespace pulvis::lab {
namespace {

constexpr std::size_t most_places = 300;    // tried for the start of sliding
constexpr std::size_t most_samples = 1500;  // of the press's record that each try looks at

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

// Sum of squares that remains of the punch displacement when the plate starts at `start`.
double unexplained(const Hold& hold, const LoggerRecord& logger, const Sliding& sliding,
                   double start) {
  const std::size_t stride = 1 + hold.time.size() / most_samples;
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
  const Eigen::VectorXd fitted = causes * causes.colPivHouseholderQr().solve(effect);
  return (effect - fitted).squaredNorm();
}

double rough_start(const Hold& hold, const LoggerRecord& logger, const Sliding& sliding,
                   double latest) {
  const Samples places = between(hold.time, hold.time.front(), latest);
  const std::size_t stride = 1 + places.count() / most_places;
  double best = hold.time.front(), least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < places.count(); i += stride) {
    const double rest = unexplained(hold, logger, sliding, hold.time[i]);
    if (rest < least) {
      least = rest;
      best = hold.time[i];
    }
  }
  return best;
}

// Looks twice: the second window has the first crossing in its middle.
std::optional<Event> event_near(const Hold& hold, double middle, double window) {
  std::optional<Bend> bend;
  for (int look = 0; look < 2; ++look) {
    const Samples s = between(hold.time, middle - window, middle + window);
    bend = find_bend(std::span(hold.time).subspan(s.begin, s.count()),
                     std::span(hold.displacement).subspan(s.begin, s.count()));
    if (!bend || !bend->is_significant()) return std::nullopt;
    middle = bend->time;
  }
  return Event{bend->time, bend->uncertainty};
}

void find_drift(Clocks& clocks, const PressRecord& press, const Hold& hold, const Sliding& sliding,
                const ClockSpec& spec) {
  if (spec.drift == static_cast<int>(ClockSpec::Drift::none) || !sliding.end) return;
  const double on_logger = sliding.end->time - sliding.start.time;
  const auto end = event_near(hold, clocks.press_start.time + on_logger, spec.window);
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
  const auto start = event_near(hold, rough_start(hold, logger, sliding, latest), spec.window);
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

}  // namespace

Samples find_hold(const PressRecord& press, double tolerance) {
  const double most = *std::max_element(press.force.begin(), press.force.end());
  std::vector<double> upper;
  for (const double force : press.force)
    if (force > most / 2) upper.push_back(force);
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
  return longest;
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
