// pulvis run: from the scene file to the results folder; pulvis resume: continues a stopped run.
#pragma once

#include <cstdio>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "cli/checkpoints.hpp"
#include "cli/exit_code.hpp"

namespace pulvis {

class Simulation;
struct Verdict;

struct RunOptions {
  std::filesystem::path scene;
  std::filesystem::path folder;  // empty: runs/<name of the scene>
  int threads = 0;               // 0: all processors
  bool overwrite = false;
  std::vector<std::string> overrides;  // key.path=value
  CheckpointOptions checkpoints;
  bool quiet = false;  // prints only errors and warnings, on standard error
  bool json = false;   // the same, and summary.json on standard output
  // Called when the folder is the run's, and its results can be read.
  std::function<void(const std::filesystem::path&)> begun{};
  // Called before the first step.
  std::function<void(Simulation&)> before_steps{};
  bool talks() const { return !quiet && !json; }
  std::FILE* warns_on() const { return talks() ? stdout : stderr; }
};

// What a quiet run prints of its expectations, on standard error: those that are not met.
void tell_unmet(const std::vector<Verdict>& verdicts);

// After a machine error ended a run that had begun: how to continue once the cause is fixed.
void tell_what_is_left(const std::filesystem::path& folder);

std::filesystem::path folder_of(const RunOptions& options);  // for the results

ExitCode run_scene(const RunOptions& options);

// pulvis resume: continues the run of a folder from its newest checkpoint.
ExitCode resume_run(const RunOptions& options);

}  // namespace pulvis
