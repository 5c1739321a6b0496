// pulvis study --slurm: hands the runs of a study over to Slurm.
#pragma once

#include "cli/campaigns/study/analysis/study_spec.hpp"
#include "cli/campaigns/study/study.hpp"

namespace pulvis {

// Submits all runs that are unfinished and not running elsewhere; with --dry-run prints how. The results folder then
// holds study.toml with its inputs, which the tasks read: later changes to the study do not affect them.
ExitCode submit_study(const StudyOptions& options, const Study& study,
                      const std::filesystem::path& folder);

}  // namespace pulvis
