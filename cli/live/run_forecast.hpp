// When a run will end, as far as its folder tells: from the stages of its scene and the samples so far.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

namespace pulvis {

class RunForecast {
 public:
  // Of a scene that cannot be read nothing is known.
  explicit RunForecast(const std::filesystem::path& scene);

  // The expected end in the units of the samples' times (s; of a lever: actions), NaN if it is not known. A stage that ends
  // at a density is extrapolated as in cli/session/end_forecast.hpp; any other `until` is expected at the end of its time.
  double end(std::span<const double> times, std::span<const double> densities) const;

 private:
  struct Stage {
    double duration = 0;
    double density = 0;  // at which it ends; 0: at the end of its time
  };
  std::vector<Stage> stages_;
};

}  // namespace pulvis
