// What a run will take, from the first milliseconds of it.
#pragma once

#include <string>

#include "scenes/simulation.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

struct RunEstimate {
  double dt = 0;       // s, the stable time step at the start
  double steps = 0;    // to the end of the last stage, with that step
  double seconds = 0;  // of this processor on one thread
};

// Moves the simulation on for a few hundredths of a second. Throws RunFailure.
RunEstimate estimate_run(Simulation& simulation);

// "run: about 120,000 steps of 1.5e-08 s; about 3 min on one thread of this machine (...)". A rough guess, and says so: powder
// in contact costs more a step than powder at rest, and the time step falls where elements are squeezed.
std::string estimate_text(const RunEstimate& estimate);

}  // namespace pulvis
