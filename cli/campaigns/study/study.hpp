// pulvis study: runs every variation of a study file, and writes its table, curves and verdicts.
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
  int jobs = 0;                  // concurrent runs; 0: as many as the processors allow
  int threads = 0;               // per run; 0: one, or the processors shared among few runs
  bool fresh = false;            // run everything again
  bool list = false;             // only list what would be run
  bool gather = false;           // run nothing, write the results of finished runs
  std::vector<std::string>
      only;  // names of runs: only these, without the study's table; empty: all
  std::vector<std::string> overrides;
  SlurmOptions slurm;
  std::string reference;  // print the study language instead: "text"
};

ExitCode run_study(const StudyOptions& options);

}  // namespace pulvis
