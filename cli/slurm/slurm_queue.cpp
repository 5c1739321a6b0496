#include "cli/slurm/slurm_queue.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <sstream>

#include "cli/slurm/captured.hpp"
#include "cli/slurm/slurm_script.hpp"
#include "cli/tell.hpp"
#include "engine/files/input_file.hpp"
#include "engine/files/own_files.hpp"

namespace pulvis {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::size_t largest_list = 64U << 20U;  // bytes

std::vector<SlurmArray> arrays_in(const fs::path& file) {
  std::error_code ignored;
  if (!fs::exists(file, ignored)) return {};
  try {
    std::vector<SlurmArray> arrays;
    const Json all = Json::parse(text_of_input(file, largest_list));
    for (const Json& array : all.at("arrays")) {
      arrays.push_back({array.at("job"), array.at("cluster"), array.at("tasks"), array.at("runs")});
      if (arrays.back().tasks == 0) throw UnfitInput("an array has no tasks");
    }
    return arrays;
  } catch (const nlohmann::json::exception& error) {
    throw OutputError(file, "read the list of Slurm runs", error.what());
  } catch (const UnfitInput& error) {
    throw OutputError(file, "read the list of Slurm runs", error.what());
  }
}

// Numbers of the pending or running tasks; nothing if Slurm does not answer. A job that it has forgotten has none.
std::optional<std::set<std::size_t>> tasks_in_queue(const SlurmArray& array, std::string& reason) {
  std::vector<std::string> words{"squeue", "--noheader", "--array", "--format=%F %K",
                                 "--jobs=" + array.job};
  if (!array.cluster.empty()) words.push_back("--clusters=" + array.cluster);
  try {
    // A user's own filters of the list would hide tasks, whose runs would be done twice.
    const Captured end = run_captured(words, ".", {"SQUEUE_"});
    const bool forgotten = end.text.find("Invalid job id") != std::string::npos;
    if (end.code != 0 && !forgotten) {
      reason = end.text.substr(0, end.text.find('\n'));
      return std::nullopt;
    }
    std::set<std::size_t> tasks;
    std::istringstream lines(end.text);
    for (std::string line, job; std::getline(lines, line);) {
      std::istringstream fields(line);
      std::size_t task = 0;
      if (fields >> job >> task && job == array.job) tasks.insert(task);
    }
    return tasks;
  } catch (const NoProgram& error) {
    reason = std::string("squeue: ") + error.what();
    return std::nullopt;
  }
}

void tell_unknown(const fs::path& folder, const SlurmArray& array, const std::string& reason) {
  tell(stderr,
       "pulvis: cannot query Slurm about job {} ({}): its unfinished runs are treated as under "
       "way; once the job has ended, remove {}\n",
       array.job, reason, (folder / slurm_arrays_file).string());
}

bool is_job_number(const std::string& text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
}

}  // namespace

SlurmQueue::SlurmQueue(fs::path folder) : folder_(std::move(folder)) {
  for (const SlurmArray& array : arrays_in(folder_ / slurm_arrays_file)) {
    std::string reason;
    const auto tasks = tasks_in_queue(array, reason);
    if (!tasks) tell_unknown(folder_, array, reason);
    if (tasks && tasks->empty()) continue;
    arrays_.push_back(array);
    for (std::size_t i = 0; i < array.runs.size(); ++i)
      if (const std::size_t task = i % array.tasks; !tasks || tasks->contains(task))
        runs_[array.runs[i]] = fmt::format("under way: task {} of Slurm job {}", task, array.job);
  }
}

void SlurmQueue::add(const SlurmArray& array) {
  arrays_.push_back(array);
  write();
}

void SlurmQueue::write() const {
  const fs::path file = folder_ / slurm_arrays_file;
  if (arrays_.empty()) return remove_own(file, role::study);
  Json all{{"arrays", Json::array()}};
  for (const SlurmArray& array : arrays_)
    all["arrays"].push_back({{"job", array.job},
                             {"cluster", array.cluster},
                             {"tasks", array.tasks},
                             {"runs", array.runs}});
  write_own(file, role::study, all.dump(2) + "\n");
}

void require_sbatch() {
  try {
    run_captured({"sbatch", "--version"}, ".");
  } catch (const NoProgram& error) {
    throw OutputError(
        "sbatch", "submit the study",
        std::string(error.what()) + "; allowed: a machine with Slurm's commands, or --dry-run");
  }
}

SlurmArray submit_slurm_script(const fs::path& folder, const std::vector<std::string>& hidden) {
  // These variables come before what the script says.
  const Captured end = run_captured({"sbatch", "--parsable", slurm_script_file}, folder, hidden);
  // "12", with several clusters "12;name"; sites may print more.
  std::istringstream lines(end.text);
  SlurmArray array;
  for (std::string line; end.code == 0 && std::getline(lines, line);) {
    const std::size_t semicolon = line.find(';');
    if (!is_job_number(line.substr(0, semicolon))) continue;
    array.job = line.substr(0, semicolon);
    if (semicolon != std::string::npos) array.cluster = line.substr(semicolon + 1);
  }
  if (!array.job.empty()) return array;
  std::string said = end.text.substr(0, end.text.find_last_not_of("\n") + 1);
  if (said.find("Invalid job array") != std::string::npos)
    said += "\nSlurm's MaxArraySize may be smaller: allowed: a smaller --array-size";
  throw OutputError(folder / slurm_script_file, "submit it",
                    fmt::format("sbatch ended with exit code {}: {}", end.code, said));
}

}  // namespace pulvis
