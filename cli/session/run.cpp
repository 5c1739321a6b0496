#include "cli/session/run.hpp"

#include <fmt/format.h>
#include <oneapi/tbb/info.h>

#include <memory>
#include <optional>
#include <utility>

#include "cli/interrupt.hpp"
#include "cli/ranks/join_ranks.hpp"
#include "cli/results_folder.hpp"
#include "cli/session/open_session.hpp"
#include "cli/session/run_afm.hpp"
#include "cli/session/session.hpp"
#include "cli/setup_progress.hpp"
#include "cli/shell_word.hpp"
#include "cli/summary.hpp"
#include "cli/tell.hpp"
#include "engine/run_failure.hpp"
#include "scenes/language/counted.hpp"
#include "scenes/memory_need.hpp"
#include "scenes/read.hpp"
#include "scenes/simulation.hpp"

namespace pulvis {
namespace {

// For several ranks whose chunks have migrated.
void print_balance(Simulation& simulation) {
  const Balance* balance = simulation.balance();
  if (balance == nullptr) return;
  for (const Rebalancing& one : balance->rebalancings())
    tell("step {}: {} migrated in {:.2g} s; the slowest rank took {:.0f}% longer than the mean{}\n",
         one.step, counted(one.chunks, "chunk"), one.seconds, 100 * imbalance_of(one.before),
         one.after.empty() ? "" : fmt::format(", then {:.0f}%", 100 * imbalance_of(one.after)));
}

}  // namespace

void tell_unmet(const std::vector<Verdict>& verdicts) {
  for (const Verdict& verdict : verdicts)
    if (!verdict.met) tell(stderr, "pulvis: expectation {}\n", verdict.text());
}

namespace {

void print_end(Session& run, const RunOptions& options) {
  if (options.json) print_summary(run.folder());
  const auto warn = [&] {
    for (const std::string& line : run.quality().lines())
      tell(options.warns_on(), "warning: {}\n", line);
  };
  if (!options.talks()) {
    warn();
    return tell_unmet(run.verdicts());
  }
  const Results& r = run.results();
  const double seconds = run.seconds();
  const std::int64_t steps = run.clock().step;
  tell("{} in {:.2f} s, {:.1f} M element updates/s; energy balance error {:.3g}\n",
       counted(steps, "step"), seconds, static_cast<double>(steps * r.elements()) / seconds * 1e-6,
       r.energy_balance_error());
  print_balance(run.simulation());
  if (r.has("stress_ratio/axial"))
    tell("relative density {:.4f}, axial stress / yield stress {:.4f}{}\n",
         r.value("relative_density"), r.value("stress_ratio/axial"),
         r.has("stress_ratio/lateral")
             ? fmt::format(", lateral {:.4f}", r.value("stress_ratio/lateral"))
             : "");
  if (const auto shear = r.shear().figures()) {
    const auto told = [](const std::optional<double>& friction) {
      return friction ? fmt::format("{:.4f}", *friction) : "none";
    };
    tell("friction static {}, dynamic {}; target moved {:.4g} mm{}\n", told(shear->static_friction),
         told(shear->dynamic_friction), shear->distance * 1e3,
         shear->dilation ? fmt::format(", dilation {:.4g} mm", *shear->dilation * 1e3) : "");
  }
  warn();
  if (!run.verdicts().empty()) tell("expectations\n");
  for (const Verdict& verdict : run.verdicts()) tell("  {}\n", verdict.text());
  tell("results in {}\n", run.folder().string());
}

// For a run that is closed and has nothing to continue.
void end_with_report(Session& run) {
  try {
    run.end_with_report();
  } catch (const OutputError&) {
    const std::string folder = run.folder().string();
    tell(stderr,
         "pulvis: the results in {} are complete, but the report is missing; once the cause is "
         "fixed, write it with: pulvis report {}\n",
         folder, shell_word(folder));
    throw;
  }
}

// A health check or a limit ended the run: that may be what the scene expects.
ExitCode stopped(Session& run, const RunOptions& options, const std::string& message) {
  run.judge(message, interrupted);
  const bool expected = ended_as_expected(run.loaded().scene, message);
  run.close((expected ? "stopped as expected: " : "failed: ") + message);
  if (!expected)
    tell(stderr, "pulvis: the run failed: {}\nthe results up to then are in {}\n", message,
         run.folder().string());
  if (!run.verdicts().empty() || options.json) print_end(run, options);
  end_with_report(run);
  return expected && all_met(run.verdicts()) ? ExitCode::done : ExitCode::run_failed;
}

// From the current state of the run to its end.
ExitCode complete(Session& run, const RunOptions& options) {
  run.hooks.stop = interrupted;
  if (options.begun) options.begun(run.folder());
  if (options.before_steps) options.before_steps(run.simulation());
  try {
    bool done = run.go() == Session::Halt::end;
    if (done) run.judge({}, interrupted);
    done = done && !interrupted();
    if (!done) run.write_checkpoint();
    const std::int64_t step = run.clock().step;
    run.close(done ? "done" : "interrupted");
    print_end(run, options);
    if (!done) {
      run.end_with_report();
      tell(stderr, "pulvis: interrupted at step {}; continue with: pulvis resume {}\n", step,
           shell_word(run.folder().string()));
      return ExitCode::interrupted;
    }
  } catch (const RunFailure& failure) {
    return stopped(run, options, failure.what());
  } catch (const OutputError&) {
    run.end_progress();
    tell_what_is_left(run.folder());
    throw;
  }
  end_with_report(run);
  run.remove_checkpoints();
  return all_met(run.verdicts()) ? ExitCode::done : ExitCode::run_failed;
}

// `ranks`: null if the process is alone.
MachineShare share_of(const RunOptions& options, Ranks* ranks) {
  MachineShare share =
      ranks != nullptr ? machine_share_of(*ranks) : MachineShare{tbb::info::default_concurrency()};
  if (options.threads > 0) share.threads = options.threads;
  return share;
}

// The role of this process in the run, if it is one of several ranks.
class RankOfRun {
 public:
  explicit RankOfRun(const RunOptions& options)
      : ranks_(join_ranks()), share_(share_of(options, ranks_.get())) {
    if (ranks_ && ranks_->is_root()) led_.emplace(*ranks_, share_.machines);
  }
  int threads() const { return share_.threads; }
  bool follows() const { return ranks_ && !led_; }
  ExitCode follow() {
    take_interrupts();  // the root reacts to them
    return follow_root(*ranks_, share_.threads);
  }
  LedRanks* led() { return led_ ? &*led_ : nullptr; }

 private:
  std::unique_ptr<Ranks> ranks_;
  MachineShare share_;
  std::optional<LedRanks> led_;
};

}  // namespace

std::filesystem::path folder_of(const RunOptions& options) {
  return results_folder(options.folder, options.scene);
}

void tell_what_is_left(const std::filesystem::path& folder) {
  if (checkpoints_in(folder).empty())
    tell(stderr,
         "pulvis: there is no checkpoint to continue from; once the cause is fixed, run it again, "
         "with --overwrite\n");
  else
    tell(stderr,
         "pulvis: the results up to then are in {}; once the cause is fixed, continue with: pulvis "
         "resume {}\n",
         folder.string(), shell_word(folder.string()));
}

ExitCode run_scene(const RunOptions& options) {
  leave_at_interrupts();
  RankOfRun rank(options);
  if (rank.follows()) return rank.follow();
  std::optional<SetupProgress> progress(std::in_place, options.talks());
  const LoadedScene loaded = load_scene(options.scene, options.overrides);
  const std::filesystem::path folder = folder_of(options);
  if (loaded.scene.afm) {
    progress.reset();
    if (rank.led() != nullptr) require_ranks_can_run(loaded.scene);
    require_free_folder(loaded, folder);
    return run_afm(loaded, options, folder, rank.threads());
  }
  const OpenSession run = open_session(loaded,
                                       {folder, rank.threads(), options.talks(),
                                        options.checkpoints, rank.led(), options.warns_on()},
                                       options.overwrite, [&] {
                                         progress.reset();
                                         take_interrupts();
                                       });
  return complete(*run.session, options);
}

ExitCode resume_run(const RunOptions& options) {
  leave_at_interrupts();
  RankOfRun rank(options);
  if (rank.follows()) return rank.follow();
  const OpenFolder stopped_run = open_stopped(options.folder, false);
  const Checkpoint& checkpoint = *stopped_run.run.checkpoint;
  const LoadedScene& loaded = stopped_run.run.scene;
  if (options.talks())
    tell("resumed at step {}, t = {:.6g} s\n", checkpoint.info().step, checkpoint.info().time);
  const int threads = rank.threads();
  if (loaded.scene.afm) return resume_afm(loaded, options, checkpoint, threads);
  require_memory(loaded.scene, machines_of(rank.led()));
  Ranks* ranks = rank.led() != nullptr ? &rank.led()->tell(loaded) : nullptr;
  std::optional<SetupProgress> progress(std::in_place, options.talks());
  Session run(loaded,
              {options.folder, threads, options.talks(), options.checkpoints, rank.led(),
               options.warns_on()},
              std::make_unique<Simulation>(loaded.scene, threads, ranks));
  progress.reset();
  take_interrupts();
  run.go_on_from(checkpoint);
  return complete(run, options);
}

}  // namespace pulvis
