// Checks of a study across its tables: series that its runs have, variations that exist, expectations
// that say one thing.
#pragma once

#include "scenes/language/problem.hpp"
#include "scenes/language/table_reader.hpp"
#include "scenes/study/study.hpp"

namespace pulvis {

// Also turns bounds with a unit into numbers, and fills in curves where the study has none.
void complete_and_check_study(Study& study, const schema::Origins& origins, Problems& problems);

const StudyRun* first_run_of(const Study& study, const std::string& variation);  // null: none

}  // namespace pulvis
