// pulvis study --slurm: what a study has to do, handed to Slurm.
#pragma once

#include "cli/study/study.hpp"
#include "scenes/study/study.hpp"

namespace pulvis {

// Submits all runs that are not finished and that nobody has, or with --dry-run prints how. The results folder holds then
// study.toml with its inputs, which the tasks read: what is changed in the study afterwards does not reach them.
ExitCode submit_study(const StudyOptions& options, const Study& study,
                      const std::filesystem::path& folder);

}  // namespace pulvis
