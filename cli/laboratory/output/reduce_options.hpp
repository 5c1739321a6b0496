// The command line of pulvis reduce.
#pragma once

#include "cli/laboratory/output/reduce.hpp"
#include "cli/options.hpp"

namespace pulvis {

struct ReduceCommand {
  ReduceOptions options;
  std::string reference;  // settings: "text" or "schema"
};

void add_reduce(CLI::App& app, ReduceCommand& command, ExitCode& code);

}  // namespace pulvis
