// Whether the numbers of a run can be relied on: its quality card, judged for the table of a study.
#pragma once

#include <string>
#include <vector>

#include "cli/study/study_results.hpp"

namespace pulvis {

// One line for each value beyond its limit, as in "hourglass energy 4.1% (limit 3%)" (`quality` of summary.json), and each
// friction loop that has no plateau; empty: nothing to object to.
std::vector<std::string> quality_flags(const StudyResult& result);

}  // namespace pulvis
