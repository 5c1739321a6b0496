// The command line of `pulvis figure`.
#pragma once

#include <CLI/CLI.hpp>

#include "cli/exit_code.hpp"
#include "cli/figure.hpp"

namespace pulvis {

void add_figure(CLI::App& app, FigureOptions& options, ExitCode& code);

}  // namespace pulvis
