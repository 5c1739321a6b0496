#include "cli/campaigns/study/study_slurm.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cli/campaigns/study/study_folder.hpp"
#include "cli/campaigns/study/study_runner.hpp"
#include "cli/interrupt.hpp"
#include "cli/shell_word.hpp"
#include "cli/slurm/slurm_queue.hpp"
#include "cli/slurm/slurm_script.hpp"
#include "cli/tell.hpp"
#include "engine/files/own_files.hpp"
#include "scenes/language/counted.hpp"

namespace pulvis {
namespace {

namespace fs = std::filesystem;

// As StudyRunner determines them; nothing is started.
std::vector<std::string> runs_to_submit(const Study& study, const fs::path& folder,
                                        const SlurmQueue& queue) {
  RunnerOptions options;
  options.elsewhere = runs_elsewhere(folder, study, queue.runs());
  const StudyRunner runner(options, study.runs, folder);
  const std::size_t finished = study.runs.size() - runner.waiting().size() - runner.elsewhere();
  tell("{}: {} to do, {} finished before, {} under way\n", counted(study.runs.size(), "run"),
       runner.waiting().size(), finished, runner.elsewhere());
  return runner.waiting();
}

// Of its own for every submission: its tasks may start after the study has changed, and has been submitted again.
fs::path copy_of_study(const fs::path& folder) {
  const auto copy = [](int number) {
    return fs::path(slurm_log_folder) / std::to_string(number) / "study.toml";
  };
  int number = 1;
  while (fs::exists((folder / copy(number)).parent_path())) ++number;
  return copy(number);
}

SlurmJob job_of(const StudyOptions& options, const fs::path& folder,
                std::vector<std::string> runs) {
  return {"pulvis-" + printable(options.study.stem().string()),
          fs::read_symlink("/proc/self/exe").string(),
          copy_of_study(folder).string(),
          std::move(runs),
          std::max(1, options.threads),
          options.jobs};
}

// Tasks would fail before their first word, and nothing would say why.
void require_path_for_slurm(const fs::path& folder) {
  const fs::path whole = fs::weakly_canonical(folder);
  if (whole.string().find_first_of("%\\") != std::string::npos)
    throw OutputError(whole, "submit a study from this folder",
                      "Slurm replaces % and \\ in the path of a task's output; allowed: a path "
                      "without them");
}

void print_job(const SlurmJob& job, const SlurmOptions& options, const fs::path& folder) {
  tell("\n# {}\n{}\n# It would be submitted with\ncd {} && sbatch --parsable {}\n",
       (folder / slurm_script_file).string(), slurm_script(job, options),
       shell_word(folder.string()), slurm_script_file);
}

}  // namespace

ExitCode submit_study(const StudyOptions& options, const Study& study, const fs::path& folder) {
  require_path_for_slurm(folder);
  if (options.slurm.dry_run) {
    const auto runs = runs_to_submit(study, folder, SlurmQueue(folder));
    if (!runs.empty()) print_job(job_of(options, folder, runs), options.slurm, folder);
    return ExitCode::done;
  }
  require_sbatch();
  take_interrupts();
  const FolderLock lock = lock_study(folder);
  SlurmQueue queue(folder);
  const SlurmJob job = job_of(options, folder, runs_to_submit(study, folder, queue));
  queue.write();
  if (job.runs.empty()) {
    tell("there is nothing to submit\n");
    return ExitCode::done;
  }
  save_study(folder, study);
  make_folder((folder / job.study).parent_path());
  save_study((folder / job.study).parent_path(), study);
  write_own(folder / slurm_script_file, role::study, slurm_script(job, options.slurm));
  SlurmArray array = submit_slurm_script(folder, variables_of_script(options.slurm));
  array.tasks = task_count(options.slurm, job.runs.size());
  array.runs = job.runs;
  queue.add(array);
  tell(
      "submitted as Slurm job {}: {} of {}; logs in {}\nthe same command without --slurm and its "
      "options collects the finished runs\n",
      array.job, counted(array.tasks, "task"), counted(job.threads, "thread"),
      (folder / slurm_log_folder).string());
  return ExitCode::done;
}

}  // namespace pulvis
