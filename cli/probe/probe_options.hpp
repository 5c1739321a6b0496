// The command line of pulvis probe.
#pragma once

#include "cli/options.hpp"
#include "cli/probe/probe.hpp"

namespace pulvis {

void add_probe(CLI::App& app, ProbeOptions& options, ExitCode& code);

}  // namespace pulvis
