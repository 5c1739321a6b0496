// The script of an array job of Slurm that does the runs of a study (docs/cluster.md).
//
// Runs are dealt out in turn: task i of n does the runs i, i + n, i + 2n, ... of the list. Each task is the program
// itself, `pulvis study study.toml --run ...`, so that a run on a cluster is the run that a study makes anywhere.
//
// Near its time limit Slurm sends USR1 to the shell alone (--signal=B:). The shell passes it on as TERM, at which runs
// write a checkpoint, and has its task queued again. A TERM of Slurm's own (scancel, preemption) ends the task for good,
// or Slurm itself queues it again (--requeue).
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace pulvis {

struct SlurmOptions {
  bool submit = false;  // what the others belong to
  bool dry_run = false;
  std::string partition, time;  // as sbatch has them; empty: the cluster's own
  int array_size = 1000;  // tasks at most; Slurm allows 1001 where its MaxArraySize is not set
  std::vector<std::string> more;  // options of sbatch
};

struct SlurmJob {
  std::string name, program;
  std::vector<std::string> runs;
  int threads = 1;  // of each task
  int at_once = 0;  // tasks at most; 0: as many as there is room for
};

constexpr const char* slurm_script_file = "slurm.sh";
constexpr const char* slurm_log_folder = "slurm";

std::size_t task_count(const SlurmOptions& options, std::size_t runs);
std::string slurm_script(const SlurmJob& job, const SlurmOptions& options);

// A word of the shell that means this text.
std::string shell_word(const std::string& text);

// Seconds of a time limit as sbatch takes it: minutes, minutes:seconds, hours:minutes:seconds, days-hours,
// days-hours:minutes or days-hours:minutes:seconds. Nothing where it is no such text, or no time at all.
std::optional<long> time_limit_seconds(const std::string& text);
constexpr const char* time_limit_forms =
    "minutes, minutes:seconds, hours:minutes:seconds, days-hours, days-hours:minutes or "
    "days-hours:minutes:seconds, above 0";

}  // namespace pulvis
