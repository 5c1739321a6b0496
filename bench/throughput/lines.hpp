// The timed measurements of a state. Every function continues the run of the state, so the particles keep
// yielding, and returns the seconds for one batch of steps.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "bench/throughput/case.hpp"

namespace pulvis::bench {

// The whole step as in a run, without samples and frames.
double step_seconds(State& state, int threads);

// Only the forces of the bodies: trial stress, return map and internal force, fused as in a step and in
// sequence with the other systems, which are not timed.
double kernel_seconds(State& state, int threads);

// The task graph of a step with the same stages, edges and chunks, but empty systems. Leaves the state
// unchanged.
double graph_seconds(State& state, int threads);

// Every system in its place in the sequence, on one thread; systems that a run fuses chunk by chunk are
// fused here too. The clock is read per system and chunk, so the sum is a few percent above a whole step.
std::map<std::string, double> system_seconds(State& state);

// Names for system_seconds, in the order of the step.
std::vector<std::string> system_names(World& world);

// Fraction of stress points that yield in the next step, which this function runs.
double flowing_share(State& state);

// Current size of all columns in bytes.
struct Memory {
  double bodies = 0, contact = 0;
};
Memory column_bytes(const World& world);

// Bytes that a step moves if nothing stays in the cache between stages: every column declared by a
// stage, once for reading and once more for writing. Meshes, which are shared by all particles, and
// resources are not counted.
double bytes_a_step(World& world);

}  // namespace pulvis::bench
