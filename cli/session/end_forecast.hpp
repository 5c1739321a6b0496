// When a run will end whose stages end at a density or displacement: extrapolated from its samples, for the progress line.
//
// A punch at constant speed makes the volume of the powder, so the inverse of its relative density, fall linearly in time.
// Before a stage with an `until` has begun, and for a force, nothing is known: its whole time is assumed.
#pragma once

#include <deque>

#include "components/run_state.hpp"
#include "components/servo.hpp"
#include "engine/world.hpp"

namespace pulvis {

class EndForecast {
 public:
  // At a sample. `relative_density` NaN: not known. Returns the expected end of the run in s, at most clock.end.
  double sample(const World& world, const Clock& clock, double relative_density);

 private:
  struct Point {
    double time = 0;
    double way = 0;  // inverse relative density, or m
  };
  // The time at which a straight line through the samples of the last part of the stage comes to `way`.
  double time_at(double way) const;

  std::size_t stage_ = static_cast<std::size_t>(-1);
  std::deque<Point> points_;  // of this stage
};

}  // namespace pulvis
