// pulvis run: a scene from its file to its results folder; pulvis resume: what was left of one.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "cli/checkpoints.hpp"
#include "cli/exit_code.hpp"

namespace pulvis {

class Simulation;

struct RunOptions {
  std::filesystem::path scene;
  std::filesystem::path folder;  // empty: runs/<name of the scene>
  int threads = 0;               // 0: all processors
  bool overwrite = false;
  std::vector<std::string> overrides;  // key.path=value
  CheckpointOptions checkpoints;
  bool quiet = false;  // nothing on the terminal but what goes wrong
  bool json = false;   // the same, and summary.json on the standard output
  // Called before the first step.
  std::function<void(Simulation&)> before_steps{};
  bool talks() const { return !quiet && !json; }
};

std::filesystem::path folder_of(const RunOptions& options);  // of the results

ExitCode run_scene(const RunOptions& options);

// pulvis resume: goes on with the run of a folder, from its newest checkpoint.
ExitCode resume_run(const RunOptions& options);

}  // namespace pulvis
