// The command line of pulvis probe.
#pragma once

#include "cli/campaigns/probe/probe.hpp"
#include "cli/options.hpp"

namespace pulvis {

void add_probe(CLI::App& app, ProbeOptions& options, ExitCode& code);

}  // namespace pulvis
