#include "cli/slurm/slurm_script.hpp"
#include "cli/shell_word.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>

namespace pulvis {
namespace {

constexpr std::size_t most_digits = 6;  // per part of a time limit

std::optional<long> whole_number(std::string_view text) {
  long value = 0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool good = !text.empty() && text.size() <= most_digits && text.front() != '-' &&
                    read.ec == std::errc() && read.ptr == text.data() + text.size();
  return good ? std::optional(value) : std::nullopt;
}

// "1:30:00" is {1, 30, 0}; empty if a part is not an integer.
std::vector<long> numbers_between_colons(std::string_view text) {
  std::vector<long> numbers;
  for (;;) {
    const std::size_t end = text.find(':');
    const std::optional<long> number = whole_number(text.substr(0, end));
    if (!number) return {};
    numbers.push_back(*number);
    if (end == std::string_view::npos) return numbers;
    text.remove_prefix(end + 1);
  }
}

// Enough for a checkpoint, and at most a quarter of the limit.
long warning_seconds(const std::string& time) {
  constexpr long enough = 120;
  const std::optional<long> limit = time_limit_seconds(time);
  return limit ? std::clamp(*limit / 4, 1L, enough) : enough;
}

constexpr const char* task_text = R"(
# Task i of {tasks} does the runs i, i + {tasks}, ...; finished runs are left as they are.
mine=()
for ((i = SLURM_ARRAY_TASK_ID; i < ${{#runs[@]}}; i += {tasks})); do mine+=(--run "${{runs[i]}}"); done

{program} study {study} -o . "${{mine[@]}}" --jobs 1 --threads-per-run "$SLURM_CPUS_PER_TASK" &
pulvis=$!

# USR1 comes before the time limit, TERM when the job is cancelled: on both, runs stop with a checkpoint.
near_limit=
trap 'near_limit=yes; kill -TERM "$pulvis"' USR1
trap 'kill -TERM "$pulvis"' TERM
while wait "$pulvis"; kill -0 "$pulvis" 2>/dev/null; do :; done  # a signal ends a wait, too
wait "$pulvis"
code=$?
# By array and task number: the job's own number would mean the whole array in one of its tasks.
if [[ -n $near_limit && $code == 130 ]]; then scontrol requeue "${{SLURM_ARRAY_JOB_ID}}_$SLURM_ARRAY_TASK_ID"; fi
exit "$code"
)";

}  // namespace

std::size_t task_count(const SlurmOptions& options, std::size_t runs) {
  return std::min(runs, static_cast<std::size_t>(options.array_size));
}

std::string slurm_script(const SlurmJob& job, const SlurmOptions& options) {
  const std::size_t tasks = task_count(options, job.runs.size());
  std::string text = "#!/bin/bash\n# Written by pulvis study --slurm; submit it from its folder.\n";
  const auto option = [&](const std::string& word) {
    text += "#SBATCH " + shell_word(word) + "\n";
  };
  option("--job-name=" + job.name);
  option(fmt::format("--array=0-{}{}", tasks - 1,
                     job.at_once > 0 ? fmt::format("%{}", job.at_once) : ""));
  option("--nodes=1");
  option("--ntasks=1");
  option(fmt::format("--cpus-per-task={}", job.threads));
  if (!options.partition.empty()) option("--partition=" + options.partition);
  if (!options.time.empty()) option("--time=" + options.time);
  option("--requeue");
  option(fmt::format("--signal=B:USR1@{}", warning_seconds(options.time)));
  option("--open-mode=append");
  option(fmt::format("--output={}/%A_%a.txt", slurm_log_folder));
  for (const std::string& more : options.more) option(more);
  text += "\nruns=(\n";
  for (const std::string& run : job.runs) text += "  " + shell_word(run) + "\n";
  text += ")\n";
  return text + fmt::format(task_text, fmt::arg("tasks", tasks),
                            fmt::arg("program", shell_word(job.program)),
                            fmt::arg("study", shell_word(job.study)));
}

std::vector<std::string> variables_of_script(const SlurmOptions& options) {
  std::vector<std::string> names{
      "SBATCH_ARRAY_INX=", "SBATCH_JOB_NAME=",  "SBATCH_REQUEUE=", "SBATCH_NO_REQUEUE=",
      "SBATCH_SIGNAL=",    "SBATCH_OPEN_MODE=", "SBATCH_OUTPUT="};
  if (!options.partition.empty()) names.emplace_back("SBATCH_PARTITION=");
  if (!options.time.empty()) names.emplace_back("SBATCH_TIMELIMIT=");
  return names;
}

std::optional<long> time_limit_seconds(const std::string& text) {
  const std::size_t dash = text.find('-');
  const bool has_days = dash != std::string::npos;
  const std::optional<long> days = has_days ? whole_number(text.substr(0, dash)) : 0;
  const std::vector<long> parts = numbers_between_colons(has_days ? text.substr(dash + 1) : text);
  if (!days || parts.empty() || parts.size() > 3) return std::nullopt;
  // Unit of the first part; each following part counts sixtieths of the one before.
  constexpr long minute = 60, hour = 3600, day = 86400;
  long unit = has_days || parts.size() == 3 ? hour : minute, seconds = *days * day;
  for (const long part : parts) {
    seconds += part * unit;
    unit /= 60;
  }
  return seconds > 0 ? std::optional(seconds) : std::nullopt;
}

}  // namespace pulvis
