// pulvis probe: loads a powder along paths, probes its states for yielding, and fits cap models.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/exit_code.hpp"

namespace pulvis {

struct ProbeOptions {
  std::filesystem::path probe;
  std::filesystem::path folder;  // empty: runs/<name of the probe>
  int jobs = 0;                  // concurrent runs; 0: as many as the processors allow
  bool fresh = false;            // run everything again
  bool list = false;             // only list what would be run
  std::vector<std::string> overrides;
  std::string reference;  // print the language reference instead
};

ExitCode run_probe(const ProbeOptions& options);

}  // namespace pulvis
