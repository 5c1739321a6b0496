// The command line of pulvis study.
#pragma once

#include "cli/campaigns/study/study.hpp"
#include "cli/options.hpp"

namespace pulvis {

void add_study(CLI::App& app, StudyOptions& options, ExitCode& code);

}  // namespace pulvis
