// What is timed of a state. Every function goes on with the state's run, so the particles keep flowing, and
// returns seconds of one batch of steps.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "bench/throughput/case.hpp"

namespace pulvis::bench {

// The whole step as a run does it, samples and frames apart.
double step_seconds(State& state, int threads);

// The forces of the bodies alone: trial stress, return map and internal force, fused as in a step and at
// their place between the others, which are not timed.
double kernel_seconds(State& state, int threads);

// A step's task graph with the same stages, edges and chunks, whose systems do nothing. Leaves the state as
// it is.
double graph_seconds(State& state, int threads);

// Every system at its place between the others, on one thread; systems that a run fuses chunk by chunk are
// fused here too. The clock is read once a system and chunk, so the sum is a few percent above a step's.
std::map<std::string, double> system_seconds(State& state);

// Names for system_seconds, in the order of the step.
std::vector<std::string> system_names(World& world);

// Share of the stress points that flow plastically in the next step, which it runs.
double flowing_share(State& state);

// Bytes of all columns now.
struct Memory {
  double bodies = 0, contact = 0;
};
Memory column_bytes(const World& world);

// Bytes that a step moves when nothing stays in a cache from one stage to the next: of every column that a
// stage declares, once for reading and once more for writing. Meshes, which all particles share, and
// resources are not counted.
double bytes_a_step(World& world);

}  // namespace pulvis::bench
