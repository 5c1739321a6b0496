#include "cli/study/study.hpp"

#include <fmt/format.h>

#include "cli/interrupt.hpp"
#include "cli/study/saved_settings.hpp"
#include "cli/study/study_fit_files.hpp"
#include "cli/study/study_report.hpp"
#include "cli/study/study_results.hpp"
#include "cli/study/study_runner.hpp"
#include "cli/tell.hpp"
#include "engine/files/output_error.hpp"
#include "engine/files/own_files.hpp"
#include "engine/files/run_folder.hpp"
#include "scenes/language/counted.hpp"
#include "scenes/study/declare_study.hpp"
#include "scenes/study/study_read.hpp"
#include "scenes/study/study_trends.hpp"

namespace pulvis {
namespace {

namespace fs = std::filesystem;
// Of the study itself.
void require_own_study(const fs::path& folder, const fs::path& study) {
  for (const char* const name :
       {"study.toml", "study.csv", "variations.csv", "effects.csv", "fits.csv", "strengths.csv",
        "sensitivities.csv", "summary.json", "curves.json", "report.html"}) {
    require_another(study, folder / name);
    require_own_or_none(folder / name, role::study);
  }
  std::error_code ignored;
  if (fs::exists(folder / "run.h5", ignored))
    throw RunFolderTaken(folder, "run a study here",
                         "it holds a run; allowed: a folder of its own");
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
  tell("{} of {} good; results in {}\n", results.size() - bad, counted(results.size(), "run"),
       folder.string());
  return bad > 0 || !all_met(verdicts) ? ExitCode::run_failed : ExitCode::done;
}

void print_list(const Study& study) {
  for (const StudyRun& run : study.runs) {
    tell("{}\n  {}\n", run.name, run.file.string());
    for (const std::string& change : run.overrides) tell("  --set '{}'\n", change);
  }
  tell("{}: good: {} of {}, {}\n", study.file.string(), counted(study.runs.size(), "run"),
       counted(study.variations.size(), "variation"),
       counted(study.spec.expects.size(), "expectation"));
}

}  // namespace

ExitCode run_study(const StudyOptions& options) {
  leave_at_interrupts();
  const Study study = load_study(options.study, options.overrides);
  if (options.list) {
    print_list(study);
    return ExitCode::done;
  }
  take_interrupts();
  const fs::path folder =
      options.folder.empty() ? fs::path("runs") / options.study.stem() : options.folder;
  require_own_study(folder, options.study);
  make_folder(folder);
  // Two studies in one folder would take each other's runs away.
  const FolderLock lock(folder, "another study is running in it");
  StudyRunner runner({options.jobs, options.threads, options.fresh}, study.runs, folder);
  save_settings(folder / "study.toml", role::study,
                whole_settings({study.text, study.file, schema::study_language(), study.files,
                                study.overrides}));
  runner.go();
  if (interrupted()) {
    tell(stderr, "pulvis: interrupted; {} of {} runs were finished, the same command continues\n",
         runner.done(), runner.to_do());
    return ExitCode::interrupted;
  }
  return finish(runner, study, folder);
}

}  // namespace pulvis
