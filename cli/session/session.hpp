// A run of a scene of particles: the loop shared by `pulvis run`, `pulvis resume` and the Python module.
//
// A run that is driven in parts, inspected between its steps or resumed takes the same steps, with bitwise identical
// results, as an uninterrupted one.
#pragma once

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "cli/checkpoints.hpp"
#include "cli/progress.hpp"
#include "cli/session/end_forecast.hpp"
#include "cli/session/ranks.hpp"
#include "cli/session/session_hooks.hpp"
#include "cli/step_limits.hpp"
#include "cli/summary.hpp"
#include "engine/files/recorder.hpp"
#include "scenes/expectations.hpp"
#include "scenes/read.hpp"
#include "scenes/results/compaction_curve.hpp"
#include "scenes/results/contact_findings.hpp"
#include "scenes/results/results.hpp"
#include "scenes/results/timetable.hpp"
#include "scenes/simulation.hpp"

namespace pulvis {

// What had been changed from outside (Session::drive) when the checkpoint was written.
std::vector<std::string> driven_in(const Checkpoint& checkpoint);

class Session {
 public:
  // How far to go.
  struct Target {
    double time = std::numeric_limits<double>::infinity();  // s
    std::int64_t step = std::numeric_limits<std::int64_t>::max();
  };
  enum class Halt { end, stop, target };
  struct Options {
    std::filesystem::path folder{};  // empty: nothing is written
    int threads = 1;
    bool talks = false;
    CheckpointOptions checkpoints{};
    LedRanks* ranks = nullptr;      // led by this process as root
    std::FILE* warns_on = nullptr;  // null: it says nothing of warnings
  };

  // `scene` as it is saved; `built` is at its start. Neither the folder nor its lock belongs to the session.
  Session(LoadedScene scene, Options options, std::unique_ptr<Simulation> built);

  // Call one of the two first.
  void begin();
  void go_on_from(const Checkpoint& checkpoint);

  // Halt::end: the last sample is taken. Throws RunFailure, OutputError and whatever hooks throw.
  Halt go(const Target& target);
  Halt go() { return go(Target()); }
  SessionHooks hooks;

  // `failure` is what stopped the run, if anything.
  void judge(const std::optional<std::string>& failure, const std::function<bool()>& stop);
  // Completes the files; `outcome` says how the run ended.
  void finish(const std::string& outcome);
  // The same in two parts. The report can be large: it is written once the simulation is gone, and nothing can follow.
  void close(const std::string& outcome);
  void end_with_report();
  // After finish: resumes like a stopped run.
  void reopen();
  void write_checkpoint();
  // The run's state or tools were changed from outside: checkpoints record it, and `pulvis resume`
  // refuses to continue without the driver. `what`: "velocity", "tool top".
  void drive(const std::string& what) { driven_.insert(what); }
  const std::set<std::string>& driven() const { return driven_; }
  void remove_checkpoints() { checkpoints_.remove(); }

  const LoadedScene& loaded() const { return loaded_; }
  const std::filesystem::path& folder() const { return options_.folder; }
  Simulation& simulation() { return *simulation_; }
  const Clock& clock() const { return simulation_->clock(); }
  const Results& results() const { return results_; }
  const std::vector<Verdict>& verdicts() const { return verdicts_; }
  RunQuality quality() const;  // what the user should know about its figures
  double seconds() const { return progress_->seconds(); }
  bool ended() const { return ended_; }
  bool open() const { return recorder_ != nullptr || !writes(); }
  // At a sample: forces and stresses belong to t_n; false between two steps.
  bool observed() const { return observed_; }
  // From a sample on, to the end of the step.
  void move();
  void end_progress() { progress_->finish(); }

 private:
  struct Spent {
    double seconds = 0;  // wall time
    std::vector<SystemCost> costs;

    template <class Bytes>
    void state(Bytes& bytes) {
      bytes(seconds, costs);
    }
  };
  bool writes() const { return !options_.folder.empty(); }
  template <class Bytes>
  void state(Bytes& bytes, RecorderPosition& position, Spent& spent);
  // Also before the run was resumed.
  std::vector<SystemCost> costs() const { return added(costs_before_, simulation_->costs()); }
  void record_into(std::unique_ptr<Recorder> recorder);
  void record_cracks();
  void record();
  bool has_passed_an_end();
  void keep_states();
  bool reached_its_end(std::size_t stage) const;
  bool stage_is_over() const;
  bool stops() const;
  bool is_every_due() const;
  bool is_tick_due() const;
  void call_between_steps();

  LoadedScene loaded_;
  Options options_;
  std::unique_ptr<Simulation> simulation_;
  Results results_;
  Expectations expectations_;
  CompactionCurve compaction_;
  ContactLoading contacts_;
  StepLimits steps_;
  std::vector<std::string> bond_warnings_;  // for bonds created at the start
  std::vector<Verdict> verdicts_;
  Timetable samples_, frames_;
  bool ended_ = false;  // and its last sample is taken
  bool observed_ = false;
  bool keeps_states_;
  std::size_t stages_over_ = 0;
  std::size_t judged_stages_ = 0;  // over at the last sample
  std::set<std::string> driven_;
  RecorderPosition closed_at_;            // by close
  std::vector<SystemCost> costs_before_;  // it was resumed
  std::int64_t told_step_ = 0;            // last step at which hooks.every was called
  std::chrono::steady_clock::time_point ticked_{};
  Checkpoints checkpoints_;
  std::unique_ptr<Recorder> recorder_;
  EndForecast forecast_;
  std::unique_ptr<Progress> progress_;
};

}  // namespace pulvis
