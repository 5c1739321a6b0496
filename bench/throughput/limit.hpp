// The limit: throughput of the kernels' work in a bare loop on this machine (limit_loop.hpp).
#pragma once

#include "components/shape.hpp"

namespace pulvis::bench {

// The loop needs AVX2 and FMA.
bool has_limit();

// Seconds for this number of steps and particles of the given shape on 1 or 2 threads. The particles are compressed
// into the plastic range, again every 80 steps; this is not timed.
double limit_seconds(const Shape& shape, int particles, int steps, int threads);

}  // namespace pulvis::bench
