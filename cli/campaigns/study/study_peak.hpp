// Values of a compaction at its highest relative density: columns of a study.
#pragma once

#include <vector>

#include "cli/campaigns/study/study_results.hpp"

namespace pulvis {

// peak/relative_density and, at that sample, forces, pressure, transmission and stress ratios; nothing for
// runs without a die of four plane tools.
std::vector<Figure> peak_values(const StudyResult& result);

}  // namespace pulvis
