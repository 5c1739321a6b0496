// Estimates the cost of a run from its first milliseconds.
#pragma once

#include <string>

#include "scenes/simulation.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

struct RunEstimate {
  double dt = 0;       // s, the stable time step at the start
  double steps = 0;    // to the end of the last stage, with that time step
  double seconds = 0;  // on one thread of this processor
};

// Advances the simulation for a few hundredths of a second. Throws RunFailure.
RunEstimate estimate_run(Simulation& simulation);

// "run: at least 120,000 steps of up to 1.5e-08 s; at least 3 min on one thread of this machine (...)". A lower bound:
// powder in contact costs more per step than powder at rest, and the time step drops where elements are compressed.
std::string estimate_text(const RunEstimate& estimate);

}  // namespace pulvis
