#include "cli/live/run_forecast.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>

#include "scenes/read.hpp"
#include "scenes/spec/afm_scene.hpp"

namespace pulvis {
namespace {

// The time at which the inverse of the density, on a straight line through the last samples, comes to that of `density`.
double time_at(double density, std::span<const double> times, std::span<const double> densities) {
  constexpr std::size_t few = 3, kept = 8;
  const std::size_t last = times.size() - 1, first = times.size() - std::min(times.size(), kept);
  if (times.size() < few) return std::numeric_limits<double>::infinity();
  const double slope = (1 / densities[last] - 1 / densities[first]) / (times[last] - times[first]);
  const double left = (1 / density - 1 / densities[last]) / slope;
  return std::isfinite(left) && left >= 0 ? times[last] + left
                                          : std::numeric_limits<double>::infinity();
}

}  // namespace

RunForecast::RunForecast(const std::filesystem::path& scene) {
  try {
    const Scene read = read_scene_alone(scene);
    if (read.afm) {
      stages_.push_back({static_cast<double>(std::max<std::size_t>(1, read.afm->actions.size()))});
      return;
    }
    limits_ = read.limits;
    for (const StageSpec& stage : read.stages)
      stages_.push_back({stage.duration, stage.until && stage.until->relative_density
                                             ? *stage.until->relative_density
                                             : 0});
  } catch (const std::exception&) {
    stages_.clear();
  }
}

double RunForecast::end(std::span<const double> times, std::span<const double> densities) const {
  if (stages_.empty()) return std::numeric_limits<double>::quiet_NaN();
  const bool has_densities = !times.empty() && densities.size() == times.size();
  double begin = 0;
  for (const Stage& stage : stages_) {
    double end = begin + stage.duration;
    if (stage.density > 0 && has_densities && times.back() > begin) {
      const auto from = std::upper_bound(times.begin(), times.end(), begin) - times.begin();
      const auto own = times.subspan(static_cast<std::size_t>(from));
      const auto reached = densities.subspan(static_cast<std::size_t>(from));
      const auto there =
          std::ranges::find_if(reached, [&](double density) { return density >= stage.density; });
      const double found = there != reached.end()
                               ? own[static_cast<std::size_t>(there - reached.begin())]
                               : time_at(stage.density, own, reached);
      end = std::clamp(found, begin, end);
    }
    begin = end;
  }
  return times.empty() ? begin : std::max(begin, times.back());
}

}  // namespace pulvis
