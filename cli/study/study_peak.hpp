// What a compaction has reached at its highest relative density: columns of a study.
#pragma once

#include <vector>

#include "cli/study/study_results.hpp"

namespace pulvis {

// peak/relative_density and, at the sample that has it, forces, pressure, transmission and stress ratios; nothing of
// runs that are not in a die of four plane tools.
std::vector<Figure> peak_values(const StudyResult& result);

}  // namespace pulvis
