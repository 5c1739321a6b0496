#include "cli/live/run_forecast.hpp"

#include <algorithm>
#include <exception>
#include <limits>

#include "cli/forecast.hpp"
#include "scenes/read.hpp"
#include "scenes/spec/afm_scene.hpp"

namespace pulvis {
namespace {

// When the stage of these samples comes to `density`; infinity: not known.
double time_of(double density, std::span<const double> times, std::span<const double> densities) {
  const std::size_t count = times.size();
  if (count < fewest_samples) return std::numeric_limits<double>::infinity();
  const std::size_t first = count - std::min(count, samples_used), last = count - 1;
  return time_at(1 / density, {times[first], 1 / densities[first]},
                 {times[last], 1 / densities[last]});
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
                               : time_of(stage.density, own, reached);
      end = std::clamp(found, begin, end);
    }
    begin = end;
  }
  return times.empty() ? begin : std::max(begin, times.back());
}

}  // namespace pulvis
