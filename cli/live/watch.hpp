// pulvis watch: shows a run under way in the browser. The process is never that of the run: it cannot disturb it.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>

#include "cli/exit_code.hpp"

namespace pulvis {

struct WatchOptions {
  std::filesystem::path folder;
  int port = 0;  // 0: any that is free
  bool of_run =
      false;  // started by `run --live`: the run's process holds the other end of standard input
};

// Its option --port.
CLI::Option* add_port(CLI::App& command, int& port);
void add_watch(CLI::App& app, WatchOptions& options, ExitCode& code);

// Until it is interrupted; of a run, until the run's process has ended and every page knows.
ExitCode watch_run(const WatchOptions& options);

}  // namespace pulvis
