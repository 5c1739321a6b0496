// When a run will end whose stages end at a density or displacement: extrapolated from its samples, for the progress line.
// Before a stage with an `until` has begun, and for a force, nothing is known: its whole time is assumed.
#pragma once

#include <deque>

#include "cli/forecast.hpp"
#include "components/run_state.hpp"
#include "components/servo.hpp"
#include "engine/world.hpp"

namespace pulvis {

class EndForecast {
 public:
  // At a sample. `relative_density` NaN: not known. Returns the expected end of the run in s, at most clock.end.
  double sample(const World& world, const Clock& clock, double relative_density);

 private:
  std::size_t stage_ = static_cast<std::size_t>(-1);
  std::deque<StageSample> samples_;  // the last ones of this stage
};

}  // namespace pulvis
