// pulvis study: every variation of a study file run, and its table, curves and verdicts written.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/exit_code.hpp"
#include "cli/slurm/slurm_script.hpp"

namespace pulvis {

struct StudyOptions {
  std::filesystem::path study;
  std::filesystem::path folder;  // empty: runs/<name of the study>
  int jobs = 0;                  // runs at once; 0: as many as the processors are enough for
  int threads = 0;               // of each run; 0: one, or the processors shared out among few runs
  bool fresh = false;            // run everything again
  bool list = false;             // only say what would be run
  bool gather = false;           // run nothing, write what there is to tell of finished runs
  std::vector<std::string>
      only;  // names of runs: these alone, without the study's table; empty: all
  std::vector<std::string> overrides;
  SlurmOptions slurm;
  std::string reference;  // the study language instead: "text"
};

ExitCode run_study(const StudyOptions& options);

}  // namespace pulvis
