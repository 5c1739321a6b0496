// The limit: what this machine does of the kernels' work in a bare loop (limit_loop.hpp).
#pragma once

#include "components/shape.hpp"

namespace pulvis::bench {

// The loop needs AVX2 and FMA.
bool has_limit();

// Seconds of so many steps of so many particles of the shape on 1 or 2 threads. The particles are squashed into the
// plastic range, anew every 80 steps; that is not timed.
double limit_seconds(const Shape& shape, int particles, int steps, int threads);

}  // namespace pulvis::bench
