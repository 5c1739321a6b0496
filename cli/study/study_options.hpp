// The command line of pulvis study.
#pragma once

#include "cli/options.hpp"
#include "cli/study/study.hpp"

namespace pulvis {

void add_study(CLI::App& app, StudyOptions& options, ExitCode& code);

}  // namespace pulvis
