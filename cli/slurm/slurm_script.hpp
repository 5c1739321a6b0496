// The script of a Slurm array job that does the runs of a study (docs/cluster.md).
//
// Runs are distributed in turn: task i of n does the runs i, i + n, i + 2n, ... of the list. Each task is the program
// itself, `pulvis study STUDY --run ...`, so that a run on a cluster is identical to a local one.
//
// Near its time limit Slurm sends USR1 to the shell alone (--signal=B:). The shell forwards it as TERM, at which runs
// write a checkpoint, and requeues its task. A TERM from Slurm itself (scancel, preemption) ends the task for good,
// or Slurm itself requeues it (--requeue).
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace pulvis {

struct SlurmOptions {
  bool submit = false;  // the other options require it
  bool dry_run = false;
  std::string partition, time;    // as in sbatch; empty: the cluster's defaults
  int array_size = 1000;          // most tasks; Slurm allows 1001 if its MaxArraySize is not set
  std::vector<std::string> more;  // further options of sbatch
};

struct SlurmJob {
  std::string name, program;
  std::string study;  // the submission's own copy, from the results folder
  std::vector<std::string> runs;
  int threads = 1;  // per task
  int at_once = 0;  // maximum number of concurrent tasks; 0: no limit
};

constexpr const char* slurm_script_file = "slurm.sh";
constexpr const char* slurm_log_folder = "slurm";

std::size_t task_count(const SlurmOptions& options, std::size_t runs);
std::string slurm_script(const SlurmJob& job, const SlurmOptions& options);
// Variables of sbatch for what the script says itself: they would replace it.
std::vector<std::string> variables_of_script(const SlurmOptions& options);

// Seconds of a time limit in sbatch notation: minutes, minutes:seconds, hours:minutes:seconds, days-hours,
// days-hours:minutes or days-hours:minutes:seconds. Nothing if the text is not in this form, or is zero.
std::optional<long> time_limit_seconds(const std::string& text);
constexpr const char* time_limit_forms =
    "minutes, minutes:seconds, hours:minutes:seconds, days-hours, days-hours:minutes or "
    "days-hours:minutes:seconds, above 0";

}  // namespace pulvis
