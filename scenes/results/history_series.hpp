// Which series the history of a run has, and what they are.
#pragma once

#include <vector>

#include "engine/files/record.hpp"
#include "scenes/spec/yield.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// The series that a run of the scene keeps, in the order of Results::sample().
std::vector<SeriesInfo> history_series(const Scene& scene);
// Of Results::momentum(), which the history leaves out: it costs a walk over all nodes.
std::vector<SeriesInfo> momentum_series(const Scene& scene);

}  // namespace pulvis
