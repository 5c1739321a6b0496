// Whether a run's numbers can be relied on: its quality card, evaluated for the table of a study.
#pragma once

#include <string>
#include <vector>

#include "cli/campaigns/study/study_results.hpp"

namespace pulvis {

// One line for each value beyond its limit, as in "hourglass energy 4.1% (limit 3%)" (`quality` of summary.json), and each
// friction loop without a plateau; empty: no objections.
std::vector<std::string> quality_flags(const StudyResult& result);

}  // namespace pulvis
