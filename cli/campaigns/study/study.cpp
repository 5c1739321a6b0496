#include "cli/campaigns/study/study.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cli/campaigns/study/analysis/study_trends.hpp"
#include "cli/campaigns/study/study_fit_files.hpp"
#include "cli/campaigns/study/study_folder.hpp"
#include "cli/campaigns/study/study_read.hpp"
#include "cli/campaigns/study/study_report.hpp"
#include "cli/campaigns/study/study_results.hpp"
#include "cli/campaigns/study/study_runner.hpp"
#include "cli/campaigns/study/study_slurm.hpp"
#include "cli/interrupt.hpp"
#include "cli/results_folder.hpp"
#include "cli/shell_word.hpp"
#include "cli/slurm/slurm_queue.hpp"
#include "cli/tell.hpp"
#include "engine/files/run_folder.hpp"
#include "scenes/language/counted.hpp"

namespace pulvis {
namespace {

namespace fs = std::filesystem;

ExitCode tell_end(const StudyRunner& runner, std::size_t of, std::size_t bad,
                  const fs::path& folder) {
  const std::size_t open = runner.elsewhere();
  tell("{} of {} good{}; results in {}\n", of - bad - open, counted(of, "run"),
       open > 0 ? fmt::format(", {} not finished yet", open) : "", folder.string());
  if (open > 0) return ExitCode::interrupted;
  return bad > 0 ? ExitCode::run_failed : ExitCode::done;
}

ExitCode finish(StudyRunner& runner, const Study& study, const fs::path& folder) {
  std::vector<StudyResult>& results = runner.read();
  const auto of = [&](const StudyRun& run) -> const StudyResult& {
    return results[static_cast<std::size_t>(&run - study.runs.data())];
  };
  const auto series = [&](const StudyRun& run, const std::string& name) {
    return of(run).series(name);
  };
  const auto failed = [&](const StudyRun& run) {
    const StudyResult& result = of(run);
    return result.usable ? std::string() : result.failure;
  };
  StudyFindings findings{judge_study(study, series, failed), fit_study(study, series, failed)};
  for (const Verdict& verdict : judge_fits(findings.fits)) findings.verdicts.push_back(verdict);
  const std::vector<Verdict>& verdicts = findings.verdicts;
  write_study(folder, study, results, findings, runner.times());
  if (!findings.fits.empty()) tell("{}", fits_text(findings.fits));
  const std::size_t bad = runner.tell_bad();
  if (!verdicts.empty()) tell("expectations\n");
  for (const Verdict& verdict : verdicts) tell("  {}\n", verdict.text());
  const ExitCode code = tell_end(runner, results.size(), bad, folder);
  return code == ExitCode::done && !all_met(verdicts) ? ExitCode::run_failed : code;
}

void print_list(const Study& study) {
  for (const StudyRun& run : study.runs) {
    tell("{}\n  {}\n", run.name, run.file.string());
    for (const std::string& change : run.overrides) tell("  --set {}\n", shell_word(change));
  }
  tell("{}: good: {} of {}, {}\n", study.file.string(), counted(study.runs.size(), "run"),
       counted(study.variations.size(), "variation"),
       counted(study.spec.expects.size(), "expectation"));
}

// Keeps the requested runs; reports those that do not exist.
bool keep_only(Study& study, const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    if (std::ranges::find(study.runs, name, &StudyRun::name) != study.runs.end()) continue;
    tell(stderr, "{}: there is no run '{}' in this study; allowed: a name that --list prints\n",
         study.file.string(), name);
    return false;
  }
  std::erase_if(study.runs, [&](const StudyRun& run) {
    return std::ranges::find(names, run.name) == names.end();
  });
  return true;
}

ExitCode tell_interrupted(const StudyRunner& runner) {
  tell(stderr,
       "pulvis: interrupted; {} of {} runs were finished; run the same command again to continue\n",
       runner.done(), runner.to_do());
  return ExitCode::interrupted;
}

// Some runs of a study whose folder may be in use by another process, which also writes the tables.
ExitCode run_part(const StudyOptions& options, const Study& study, const fs::path& folder) {
  take_interrupts();
  make_folder(folder);
  StudyRunner runner({options.jobs, options.threads, options.fresh,
                      runs_elsewhere(folder, study, {}), options.gather},
                     study.runs, folder);
  runner.go();
  if (!interrupted()) {
    const std::size_t runs = runner.read().size(), bad = runner.tell_bad();
    return tell_end(runner, runs, bad, folder);
  }
  if (runner.has_come_further()) return tell_interrupted(runner);
  // A task requeued because of this would never finish.
  tell(stderr, "pulvis: interrupted before the first step of a run; more time is needed\n");
  return ExitCode::machine;
}

}  // namespace

ExitCode run_study(const StudyOptions& options) {
  leave_at_interrupts();
  Study study = load_study(options.study, options.overrides);
  if (!options.only.empty() && !keep_only(study, options.only)) return ExitCode::usage;
  if (options.list) {
    print_list(study);
    return ExitCode::done;
  }
  const fs::path folder = results_folder(options.folder, options.study);
  if (!options.only.empty() && !options.slurm.submit) return run_part(options, study, folder);
  require_own_study(folder, options.study);
  if (options.slurm.submit) return submit_study(options, study, folder);
  take_interrupts();
  const FolderLock lock = lock_study(folder);
  const SlurmQueue queue(folder);
  StudyRunner runner({options.jobs, options.threads, options.fresh,
                      runs_elsewhere(folder, study, queue.runs()), options.gather},
                     study.runs, folder);
  queue.write();
  save_study(folder, study);
  runner.go();
  return interrupted() ? tell_interrupted(runner) : finish(runner, study, folder);
}

}  // namespace pulvis
