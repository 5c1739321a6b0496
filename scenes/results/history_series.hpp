// The series in the history of a run, with their descriptions.
#pragma once

#include <vector>

#include "engine/files/record.hpp"
#include "scenes/spec/yield.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// The series recorded by a run of the scene, in the order of Results::sample().
std::vector<SeriesInfo> history_series(const Scene& scene);
// For Results::momentum(), which the history omits: it costs a loop over all nodes.
std::vector<SeriesInfo> momentum_series(const Scene& scene);

}  // namespace pulvis
