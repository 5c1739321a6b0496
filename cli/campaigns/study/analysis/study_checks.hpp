// Checks of a study across its tables: series that its runs have, variations that exist, expectations
// that are unambiguous.
#pragma once

#include "cli/campaigns/study/analysis/study_spec.hpp"
#include "scenes/language/problem.hpp"
#include "scenes/language/table_reader.hpp"

namespace pulvis {

// Also converts bounds with a unit to numbers, and adds default curves if the study has none.
void complete_and_check_study(Study& study, const schema::Origins& origins, Problems& problems);

const StudyRun* first_run_of(const Study& study, const std::string& variation);  // null: none

}  // namespace pulvis
