// pulvis fit: calibrates keys of a simulated sliding-plate test until its friction matches the test.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/exit_code.hpp"

namespace pulvis {

struct FitOptions {
  std::filesystem::path fit;
  std::filesystem::path folder;  // empty: runs/<name of the fit>
  int jobs = 0;                  // concurrent runs; 0: as many as the processors allow
  bool fresh = false;            // run everything again
  std::vector<std::string> overrides;
  std::string reference;  // print the language reference instead
};

ExitCode run_fit(const FitOptions& options);

}  // namespace pulvis
