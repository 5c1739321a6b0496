// The series in the history of a run, and the fields of its frames beside those of the mesh.
#pragma once

#include <vector>

#include "engine/files/record.hpp"
#include "scenes/results/parts/frame_fields.hpp"
#include "scenes/results/parts/observables.hpp"
#include "scenes/spec/scene.hpp"
#include "scenes/spec/yield.hpp"

namespace pulvis {

// The history: one row of the table per column.
Observables observables(const Scene& scene);
// Momentum, which the history omits: it costs a loop over all nodes.
Observables momentum_of(const Scene& scene);
FrameFields frame_fields(const Scene& scene);

// Of these tables, without a world.
std::vector<SeriesInfo> history_series(const Scene& scene);
std::vector<SeriesInfo> momentum_series(const Scene& scene);

}  // namespace pulvis
