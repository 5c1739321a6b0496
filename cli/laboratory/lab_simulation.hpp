// The friction curve of a simulated test, from the history.csv of its run folder.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scenes/language/csv_table.hpp"

namespace pulvis::lab {

struct SimulatedCurve {
  std::string name;              // of the folder
  std::vector<double> distance;  // m, travel of the target along x since it began to move
  std::vector<double> friction;  // -, lateral over normal force on the target
};

// The name of a run: its folder.
std::string name_of_run(const std::filesystem::path& run_folder);

// history.csv of a run. Rejected: none, or one of a run in three dimensions.
csv::Table history_of_run(const std::filesystem::path& run_folder);

// Rejected: no such tool, a target that does not move along x.
SimulatedCurve read_simulation(const std::filesystem::path& run_folder, const std::string& target);

}  // namespace pulvis::lab
