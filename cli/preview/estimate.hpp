// Estimates the cost of a run: from its first steps, the densities that its stages reach, and how much more the steps of other
// powders have cost as contacts formed.
#pragma once

#include <string>
#include <vector>

#include "cli/preview/stage_forecast.hpp"
#include "scenes/simulation.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

struct RunEstimate {
  double dt = 0;         // s, the stable time step at the start
  double steps = 0;      // to the end of the last stage
  double seconds = 0;    // of one processor
  bool is_most = false;  // a stage ends at a condition that may be met at any time before
};

// Advances the simulation for some tenths of a second. `particles`: how many. Throws RunFailure.
RunEstimate estimate_run(Simulation& simulation, const Scene& scene, std::size_t particles,
                         const std::vector<StageForecast>& stages);

// "run: about 39,000 steps of up to 7.2e-08 s; about 7 s of one processor (...)".
std::string estimate_text(const RunEstimate& estimate);

}  // namespace pulvis
