// Extrapolation of a run under way to the end of a stage: for its progress line, and for those who watch its folder.
//
// A punch at constant speed makes the volume of the powder, so the inverse of its relative density, fall linearly in time.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>

namespace pulvis {

struct StageSample {
  double time = 0;  // s
  double way = 0;   // inverse relative density, or displacement in m
};

// Of the samples of the stage, the last ones are used; before there are a few, nothing is known.
inline constexpr std::size_t samples_used = 8, fewest_samples = 3;

// The time at which the straight line through two samples comes to `way`; infinity: never.
inline double time_at(double way, const StageSample& from, const StageSample& to) {
  const double slope = (to.way - from.way) / (to.time - from.time);
  const double left = (way - to.way) / slope;
  return std::isfinite(left) && left >= 0 ? to.time + left
                                          : std::numeric_limits<double>::infinity();
}

}  // namespace pulvis
