// pulvis reduce: from raw records of sliding-plate tests, or AFM friction loops on slopes, to friction, figures
// and a report.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/exit_code.hpp"

namespace pulvis {

struct ReduceOptions {
  std::vector<std::filesystem::path> files;  // records (CSV), and settings if they end in .toml
  std::vector<std::filesystem::path> simulations;  // run folders
  std::filesystem::path folder = "reduced";
  std::vector<std::string> overrides;  // key.path=value
  bool overwrite = false;
};

ExitCode reduce_records(const ReduceOptions& options);

}  // namespace pulvis
