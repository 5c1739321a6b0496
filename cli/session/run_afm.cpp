#include "cli/session/run_afm.hpp"

#include <fmt/format.h>

#include "cli/interrupt.hpp"
#include "cli/plan.hpp"
#include "cli/save_scene.hpp"
#include "cli/session/afm_session.hpp"
#include "cli/session/open_session.hpp"
#include "cli/session/run.hpp"
#include "cli/shell_word.hpp"
#include "cli/summary.hpp"
#include "cli/summary_afm.hpp"
#include "cli/tell.hpp"
#include "engine/files/checkpoint.hpp"
#include "engine/files/run_folder.hpp"
#include "scenes/checks/lever_warnings.hpp"
#include "scenes/expectations.hpp"
#include "scenes/language/counted.hpp"
#include "scenes/lever/afm_simulation.hpp"
#include "scenes/lever/afm_size.hpp"
#include "scenes/memory_need.hpp"
#include "scenes/spec/afm_scene.hpp"

namespace pulvis {
namespace {

void print_afm_end(const AfmReport& report, const std::filesystem::path& folder) {
  tell("{}", calibration_text(*report.calibration));
  for (const FrictionLoop& loop : report.loops) tell("{}", loop_text(loop));
  for (const auto* curves : {&report.curves, &report.unreleased})
    for (const ForceCurveFigures& curve : *curves) tell("{}", curve_text(curve));
  if (report.wedge && report.loops.size() > 1) tell("{}", wedge_summary(*report.wedge));
  tell("{}, {}, {}, {:.2f} s\n", counted(report.elements, "element"), counted(report.nodes, "node"),
       counted(report.increments, "increment"), report.wall_seconds);
  if (!report.verdicts.empty()) tell("expectations\n");
  for (const Verdict& verdict : report.verdicts) tell("  {}\n", verdict.text());
  tell("results in {}\n", folder.string());
}

void refuse_checkpoint_time(const LoadedScene& loaded, const RunOptions& options) {
  if (options.checkpoints.time > 0)
    throw SceneError(
        {{loaded.scene.file, 1, 1, "", "--checkpoint-time",
          "the programme of a lever has no simulated time, allowed: --checkpoint-steps"}});
}

ExitCode complete_programme(AfmSession& run, const RunOptions& options, const Checkpoint* from) {
  run.hooks.stop = interrupted;
  if (options.begun) options.begun(run.folder());
  try {
    run.run(from);
  } catch (const OutputError&) {
    tell_what_is_left(run.folder());
    throw;
  }
  run.finish();
  const ProgrammeEnd& end = run.end();
  const AfmReport& report = run.report();
  for (const std::string& line : report.warnings) tell(stderr, "warning: {}\n", line);
  if (options.json) print_summary(run.folder());
  if (!options.talks())
    tell_unmet(report.verdicts);
  else if (report.calibration)
    print_afm_end(report, run.folder());
  const bool expected = end.failure.empty() || ended_as_expected(run.loaded().scene, end.failure);
  if (!expected) tell(stderr, "pulvis: the run failed: {}\n", end.failure);
  if (!end.done && end.failure.empty()) {
    if (checkpoints_in(run.folder()).empty()) {
      tell(stderr,
           "pulvis: interrupted before the first increment; run it again, with --overwrite\n");
      return ExitCode::interrupted;
    }
    tell(stderr, "pulvis: interrupted at increment {}; continue with: pulvis resume {}\n",
         report.increments, shell_word(run.folder().string()));
    return ExitCode::interrupted;
  }
  return expected && all_met(report.verdicts) ? ExitCode::done : ExitCode::run_failed;
}

}  // namespace

ExitCode run_afm(const LoadedScene& loaded, const RunOptions& options,
                 const std::filesystem::path& folder, int threads) {
  refuse_checkpoint_time(loaded, options);
  require_afm_memory(loaded.scene);
  for (const std::string& line : lever_warnings(loaded.scene))
    tell(options.warns_on(), "warning: {}\n", line);
  AfmSession run(loaded, threads);
  take_interrupts();
  const FolderLock lock = open_run_folder(folder, options.overwrite);
  whole_or_nothing(folder, [&] {
    save_scene(folder, loaded);
    run.write_to(folder, options.checkpoints);
  });
  return complete_programme(run, options, nullptr);
}

ExitCode resume_afm(const LoadedScene& loaded, const RunOptions& options,
                    const Checkpoint& checkpoint, int threads) {
  refuse_checkpoint_time(loaded, options);
  require_afm_memory(loaded.scene);
  AfmSession run(loaded, threads);
  take_interrupts();
  run.write_to(options.folder, options.checkpoints);
  return complete_programme(run, options, &checkpoint);
}

ExitCode plan_afm(const Scene& scene, bool dot) {
  AfmSimulation simulation(scene);
  tell("{}",
       dot ? plan_dot(simulation.plan()) : plan_text(simulation.plan(), {}, simulation.world()));
  return ExitCode::done;
}

}  // namespace pulvis
