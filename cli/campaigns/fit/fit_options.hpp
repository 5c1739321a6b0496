// The command line of pulvis fit.
#pragma once

#include "cli/campaigns/fit/fit.hpp"
#include "cli/options.hpp"

namespace pulvis {

void add_fit(CLI::App& app, FitOptions& options, ExitCode& code);

}  // namespace pulvis
