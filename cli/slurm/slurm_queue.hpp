// Which runs of a study are queued or running in Slurm.
//
// slurm.json in the study's folder lists the submitted arrays: {"arrays": [{"job": "12", "cluster": "",
// "tasks": 2, "runs": ["friction=0.1", ...]}]}, with runs distributed over the tasks as in slurm_script.hpp. Only Slurm
// knows which tasks are still pending or running (squeue).
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace pulvis {

struct SlurmArray {
  std::string job;      // its number
  std::string cluster;  // in a multi-cluster set-up; else empty
  std::size_t tasks = 1;
  std::vector<std::string> runs;
};

constexpr const char* slurm_arrays_file = "slurm.json";

class SlurmQueue {
 public:
  // For a study's folder, which need not exist. Arrays that have ended are dropped. If Slurm cannot be queried, all
  // count as queued, and a message is printed.
  explicit SlurmQueue(std::filesystem::path folder);

  // Runs of pending or running tasks, and who has them: "under way: task 3 of Slurm's job 12".
  const std::map<std::string, std::string>& runs() const { return runs_; }
  void add(const SlurmArray& array);  // also written to slurm.json
  void write() const;                 // slurm.json with what is left; removed if empty

 private:
  std::filesystem::path folder_;
  std::vector<SlurmArray> arrays_;
  std::map<std::string, std::string> runs_;
};

// Submits slurm.sh of this folder. Throws OutputError with sbatch's message.
SlurmArray submit_slurm_script(const std::filesystem::path& folder,
                               const std::vector<std::string>& hidden);
void require_sbatch();  // throws OutputError

}  // namespace pulvis
