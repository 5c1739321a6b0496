// pulvis probe: a powder loaded along paths, its states probed for where they yield, and cap models fitted.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/exit_code.hpp"

namespace pulvis {

struct ProbeOptions {
  std::filesystem::path probe;
  std::filesystem::path folder;  // empty: runs/<name of the probe>
  int jobs = 0;                  // runs at once; 0: as many as the processors are enough for
  bool fresh = false;            // run everything again
  bool list = false;             // only say what would be run
  std::vector<std::string> overrides;
  std::string reference;  // print the language instead
};

ExitCode run_probe(const ProbeOptions& options);

}  // namespace pulvis
