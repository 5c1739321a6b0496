#include "cli/campaigns/fit/fit.hpp"

#include <fmt/format.h>

#include <cmath>

#include "cli/campaigns/fit/declare_fit.hpp"
#include "cli/campaigns/fit/fit_files.hpp"
#include "cli/campaigns/study/saved_settings.hpp"
#include "cli/campaigns/study/study_runner.hpp"
#include "cli/interrupt.hpp"
#include "cli/results_folder.hpp"
#include "cli/tell.hpp"
#include "engine/files/own_files.hpp"
#include "engine/files/run_folder.hpp"

namespace pulvis {
namespace {

namespace fs = std::filesystem;

void require_own_fit(const fs::path& folder, const PlateFit& fit) {
  for (const char* const name : {"fit.toml", "fit.json", "trials.csv", "report.html"}) {
    require_another(fit.file, folder / name);
    require_own_or_none(folder / name, role::fit);
  }
  std::error_code ignored;
  for (const char* const other : {"run.h5", "study.toml", "probe.toml", "reduce.toml"})
    if (fs::exists(folder / other, ignored))
      throw RunFolderTaken(folder, "fit here",
                           "it holds other results; allowed: a folder of its own");
}

bool is_scene(const PlateFit& fit, const std::vector<double>& values) {
  try {
    load_scene(fit.scene_file(), fit.settings_at(values));
    return true;
  } catch (const SceneError&) {
    return false;
  }
}

std::vector<FreeParameter> free_parameters(const PlateFit& fit) {
  std::vector<FreeParameter> free;
  for (const SoughtKey& k : fit.spec.parameters) free.push_back({k.start, k.low, k.high, k.step});
  return free;
}

class Fitting {
 public:
  Fitting(const FitOptions& options, const PlateFit& fit, fs::path folder)
      : options_(options),
        fit_(fit),
        folder_(std::move(folder)),
        comparison_(fit),
        search_(free_parameters(fit), fit.spec.tolerance, fit.spec.max_rounds,
                [&fit](const std::vector<double>& values) { return is_scene(fit, values); }) {}

  ExitCode go() {
    while (search_.state() == GaussNewton::State::going)
      if (const auto failed = round()) return *failed;
    if (search_.best().empty()) {
      tell(stderr,
           "pulvis: no value other than the start gives a valid scene: nothing can be fitted\n");
      return ExitCode::run_failed;
    }
    FitResult result{fit_, comparison_, search_, std::move(trials_), {}, {}};
    result.parameters =
        comparison_.parameters(search_.best(), search_.residuals(), search_.jacobian());
    result.warnings = warnings(result.parameters);
    write_fit(folder_, result);
    for (const std::string& sentence : comparison_.limits()) tell("{}\n", sentence);
    for (const std::string& sentence : result.warnings) tell("warning: {}\n", sentence);
    tell("{}\nresults in {}\n", fit_text(result), folder_.string());
    return search_.state() == GaussNewton::State::converged ? ExitCode::done : ExitCode::run_failed;
  }

 private:
  StudyRun run_of(const std::vector<double>& values) const {
    StudyRun run;
    for (std::size_t k = 0; k < values.size(); ++k)
      run.name += fmt::format("{}{}={}", k > 0 ? "," : "", fit_.spec.parameters[k].short_name(),
                              fit_.spec.parameters[k].text(values[k]));
    run.variation = run.name;
    run.file = fit_.scene_file();
    run.overrides = fit_.settings_at(values);
    LoadedScene loaded = load_scene(run.file, run.overrides);
    run.scene = std::move(loaded.scene);
    run.hash = loaded.hash;
    return run;
  }

  // None: it ran to its end.
  std::optional<ExitCode> round() {
    std::vector<StudyRun> runs;
    for (const auto& values : search_.asks()) runs.push_back(run_of(values));
    StudyRunner runner({options_.jobs, 1, options_.fresh}, runs, folder_);
    tell("round {}: ", search_.rounds() + 1);
    runner.go();
    if (interrupted()) {
      tell(stderr, "pulvis: interrupted; run the same command again to continue\n");
      return ExitCode::interrupted;
    }
    std::vector<Eigen::VectorXd> residuals;
    const std::vector<StudyResult>& results = runner.read();
    for (std::size_t i = 0; i < results.size(); ++i) {
      if (!results[i].usable) {
        runner.tell_bad();
        return ExitCode::run_failed;
      }
      FitTrial trial{search_.asks()[i], runs[i].name, 0,
                     lab::read_simulation(results[i].folder, fit_.spec.target)};
      if (trials_.empty()) comparison_.set_reach(trial.curve);
      residuals.push_back(comparison_.residuals(trial.curve));
      trial.misfit =
          std::sqrt(residuals.back().squaredNorm() / static_cast<double>(residuals.back().size()));
      tell("  {}: misfit {:.5g}\n", trial.run, trial.misfit);
      trials_.push_back(std::move(trial));
    }
    search_.tell(residuals);
    return std::nullopt;
  }

  std::vector<std::string> warnings(const std::vector<lab::Measured>& found) const {
    std::vector<std::string> told;
    for (std::size_t k = 0; k < fit_.spec.parameters.size(); ++k) {
      const std::string name = fit_.spec.parameters[k].short_name();
      if (search_.is_at_bound(k))
        told.push_back(
            fmt::format("{} is at the end of its range: its interval is not meaningful", name));
      if (!(search_.jacobian().col(static_cast<Eigen::Index>(k)).norm() > 0))
        told.push_back(fmt::format(
            "the simulated friction does not depend on {}, which therefore cannot be determined",
            name));
      else if (!found[k].has_interval())
        told.push_back(fmt::format(
            "changes of the other keys have the same effect on the friction as those of {}, which "
            "therefore cannot be determined",
            name));
    }
    if (search_.is_at_limit())
      told.push_back(
          "the best values are at the limit of valid scenes, which keeps them from a better fit: "
          "the intervals are not meaningful");
    if (search_.state() != GaussNewton::State::converged)
      told.push_back("not converged: the values are those of the best run");
    return told;
  }

  const FitOptions& options_;
  const PlateFit& fit_;
  fs::path folder_;
  PlateComparison comparison_;
  GaussNewton search_;
  std::vector<FitTrial> trials_;
};

}  // namespace

ExitCode run_fit(const FitOptions& options) {
  leave_at_interrupts();
  const PlateFit fit = load_plate_fit(options.fit, options.overrides);
  const fs::path folder = results_folder(options.folder, options.fit);
  require_own_fit(folder, fit);
  Fitting fitting(options, fit, folder);
  take_interrupts();
  make_folder(folder);
  const FolderLock lock(folder, "another fit is running in it");
  save_settings(
      folder / "fit.toml", role::fit,
      whole_settings({fit.text, fit.file, schema::fit_language(), fit.files, fit.overrides}));
  return fitting.go();
}

}  // namespace pulvis
