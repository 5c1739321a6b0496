// pulvis fit: keys of a simulated sliding-plate test, sought until its friction is the measured one.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/exit_code.hpp"

namespace pulvis {

struct FitOptions {
  std::filesystem::path fit;
  std::filesystem::path folder;  // empty: runs/<name of the fit>
  int jobs = 0;                  // runs at once; 0: as many as the processors are enough for
  bool fresh = false;            // run everything again
  std::vector<std::string> overrides;
  std::string reference;  // print the language instead
};

ExitCode run_fit(const FitOptions& options);

}  // namespace pulvis
