#include "cli/laboratory/lab_sliding.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pulvis::lab {
namespace {

constexpr double standing_still = 0.1;  // of the sliding speed: below it the plate is at rest

// Where the chord through 5 and 20 % of the distance meets zero distance.
double start_by_chord(const std::vector<double>& t, const std::vector<double>& distance,
                      double whole) {
  const auto reaches = [&](double share) {
    const auto at = std::find_if(distance.begin(), distance.end(),
                                 [&](double w) { return w >= share * whole; });
    return t[static_cast<std::size_t>(at - distance.begin())];
  };
  const double t5 = reaches(0.05), t20 = reaches(0.2);
  return t5 - (t20 - t5) / 3;
}

// The plate starts to move; `distance` is counted from there.
std::optional<BendEvent> departure(const std::vector<double>& t,
                                   const std::vector<double>& distance, double whole,
                                   double window) {
  const auto found = event_near(t, distance, start_by_chord(t, distance, whole), window);
  if (!found) return std::nullopt;
  const Bend& bend = found->bend;
  const bool departs = std::abs(bend.before.slope) < standing_still * std::abs(bend.after.slope);
  return departs ? found : std::nullopt;
}

std::optional<Event> find_end(const LoggerRecord& logger, const Sliding& sliding, double whole,
                              double window) {
  // The distance from the plate's final position, as if time ran backwards.
  std::vector<double> t = logger.time, distance = sliding.distance;
  std::reverse(t.begin(), t.end());
  std::reverse(distance.begin(), distance.end());
  for (double& time : t) time = -time;
  for (double& w : distance) w = whole - w;
  const auto found = departure(t, distance, whole, window);
  if (!found) return std::nullopt;
  return Event{-found->event.time, found->event.uncertainty};
}

// The last sample at which the plate is known to be moving, since the next one is further: by the sample of its
// arrival the load cell may have unloaded. `distance` ends at `whole`, except for noise.
std::size_t last_moving(const std::vector<double>& t, const std::vector<double>& distance,
                        double start, double whole) {
  const double sample_distance =
      whole * (t.back() - t.front()) / (static_cast<double>(t.size() - 1) * (t.back() - start));
  const auto arrived = std::find_if(distance.begin(), distance.end(), [&](double w) {
    return w >= whole - standing_still * sample_distance;
  });
  return static_cast<std::size_t>(std::max<std::ptrdiff_t>(arrived - distance.begin() - 1, 0));
}

}  // namespace

Sliding find_sliding(const LoggerRecord& logger, const Settings& settings) {
  const double sensitivity = settings.lvdt.sensitivity, window = settings.clock.window;
  Sliding sliding;
  const double first = logger.lvdt.front();
  for (const double volts : logger.lvdt) sliding.distance.push_back((volts - first) / sensitivity);
  std::vector<double>& distance = sliding.distance;
  const auto [low, high] = std::minmax_element(distance.begin(), distance.end());
  if (-*low > *high)
    for (double& w : distance) w = -w;
  const double whole = *std::max_element(distance.begin(), distance.end());
  if (!(whole >= settings.analysis.shortest_sliding))
    refuse(logger, settings.logger.lvdt,
           fmt::format("the plate slides {:.4g} mm, allowed: at least {:.4g} mm "
                       "(analysis.shortest_sliding)",
                       whole * 1e3, settings.analysis.shortest_sliding * 1e3));
  const auto found = departure(logger.time, distance, whole, window);
  if (!found)
    refuse(logger, settings.logger.lvdt,
           fmt::format("no start of sliding is found, allowed: at least 5 samples at rest and as "
                       "many at a steady speed within {:g} s of the start (clock.window)",
                       window));
  sliding.start = found->event;
  sliding.end = find_end(logger, sliding, whole, window);
  const std::size_t last = last_moving(logger.time, distance, sliding.start.time, whole);
  sliding.last_time =
      std::min(sliding.end ? sliding.end->time : logger.time.back(), logger.time[last]);
  const double rest = found->bend.before.at(found->event.time);
  for (double& w : distance) w -= rest;
  return sliding;
}

}  // namespace pulvis::lab
