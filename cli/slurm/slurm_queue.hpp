// Which runs of a study are in the hands of Slurm.
//
// slurm.json in the study's folder has the arrays that were submitted: {"arrays": [{"job": "12", "cluster": "",
// "tasks": 2, "runs": ["friction=0.1", ...]}]}, runs dealt out to the tasks as in slurm_script.hpp. Which tasks are
// still waiting or running only Slurm knows (squeue).
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace pulvis {

struct SlurmArray {
  std::string job;      // its number
  std::string cluster;  // of several; else empty
  std::size_t tasks = 1;
  std::vector<std::string> runs;
};

constexpr const char* slurm_arrays_file = "slurm.json";

class SlurmQueue {
 public:
  // Of a study's folder, which need not be there. Arrays that have ended are forgotten. Where Slurm cannot be asked, all
  // count as queued, and the terminal is told so.
  explicit SlurmQueue(std::filesystem::path folder);

  // Runs of tasks that wait or run, and who has them: "under way: task 3 of Slurm's job 12".
  const std::map<std::string, std::string>& runs() const { return runs_; }
  void add(const SlurmArray& array);  // slurm.json has it then
  void write() const;                 // slurm.json of what is left; without any it goes

 private:
  std::filesystem::path folder_;
  std::vector<SlurmArray> arrays_;
  std::map<std::string, std::string> runs_;
};

// Submits slurm.sh of this folder. Throws OutputError with sbatch's own words.
SlurmArray submit_slurm_script(const std::filesystem::path& folder);
void require_sbatch();  // throws OutputError

}  // namespace pulvis
