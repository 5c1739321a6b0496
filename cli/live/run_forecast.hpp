// What is known of a run from its scene: when it will end, with the samples so far, and its limits.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "scenes/spec/results_spec.hpp"

namespace pulvis {

class RunForecast {
 public:
  // Of a scene that cannot be read nothing is known.
  explicit RunForecast(const std::filesystem::path& scene);

  // The expected end in the units of the samples' times (s; of a lever: actions), NaN if it is not known. A stage that ends
  // at a density is extrapolated (cli/forecast.hpp); any other `until` is expected at the end of its time.
  double end(std::span<const double> times, std::span<const double> densities) const;
  // Of a powder; a lever has none.
  const std::optional<LimitSpec>& limits() const { return limits_; }

 private:
  struct Stage {
    double duration = 0;
    double density = 0;  // at which it ends; 0: at the end of its time
  };
  std::vector<Stage> stages_;
  std::optional<LimitSpec> limits_;
};

}  // namespace pulvis
