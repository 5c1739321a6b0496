// A run of a scene of the family "afm": calibration, then its programme, increment by increment. For `pulvis run`,
// `pulvis resume` and the Python module.
#pragma once

#include <chrono>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/checkpoints.hpp"
#include "cli/session/session_hooks.hpp"
#include "cli/summary_afm.hpp"
#include "engine/files/checkpoint.hpp"
#include "engine/files/recorder.hpp"
#include "scenes/lever/afm_loop.hpp"
#include "scenes/lever/afm_simulation.hpp"
#include "scenes/read.hpp"

namespace pulvis {

struct ProgrammeEnd {
  bool done = false;
  bool given_up = false;  // in the middle of an equilibrium search: the world is unusable
  std::string failure{};
};

class AfmSession {
 public:
  // How far to go.
  struct Target {
    double actions = std::numeric_limits<double>::infinity();  // done, including part of one
    std::int64_t increment = std::numeric_limits<std::int64_t>::max();
  };

  // Calibrates, which may take minutes: before any folder is touched.
  AfmSession(LoadedScene scene, int threads);

  // Folder for the run's files; without one nothing is written.
  void write_to(const std::filesystem::path& folder, const CheckpointOptions& options);
  // Starts the programme at a checkpoint, once; without it, go() starts at the beginning.
  void begin(const Checkpoint* from);
  // To the end of the programme, or until it is stopped; without actions, the load cases of the calibration.
  void run(const Checkpoint* from = nullptr);
  // The same in parts, with bitwise identical results: to a target, until over(); then, or earlier, leave().
  void go(const Target& target);
  void leave();  // completes the run's files; leaves a checkpoint if the run has not ended
  // Nothing is left to resume.
  bool over() const { return end_.done || end_.given_up || !end_.failure.empty() || has_left_; }
  // Writes the outcome: verdicts, summary and report.
  void finish();

  SessionHooks hooks;  // `every` counts increments
  const LoadedScene& loaded() const { return loaded_; }
  const ProgrammeEnd& end() const { return end_; }
  const AfmReport& report() const { return report_; }
  const AfmHistory& history() const { return history_; }
  const std::filesystem::path& folder() const { return folder_; }
  AfmSimulation& simulation() { return simulation_; }
  std::int64_t increment() const { return position_.told - 1; }  // -1: not started

 private:
  bool writes() const { return !folder_.empty(); }
  void open_recorder(const Checkpoint* from);
  void run_programme();
  bool reached() const;
  bool take(double time, const std::vector<double>& row);
  void frame(double time);
  void tell(double time, const std::vector<double>& row, bool is_frame);
  bool stops() const;
  template <class State>
  void write_checkpoint(const State& state);
  void write_kept_checkpoint();
  double seconds() const;  // wall time, also before the run was resumed
  void keep();
  bool yields();
  std::vector<FieldInfo> fields();
  void refuse_calibration();

  const LoadedScene loaded_;
  int threads_;
  std::filesystem::path folder_;
  AfmSimulation simulation_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  double seconds_before_ = 0;
  AfmReport report_;
  AfmHistory history_;
  ProgrammeEnd end_;
  RunMesh mesh_;
  std::optional<Checkpoints> checkpoints_;
  AfmPosition position_;
  std::unique_ptr<Recorder> recorder_;
  std::size_t every_ = 1;  // increments per frame
  std::size_t total_ = 1;  // rows of the complete history
  Target target_;
  bool has_begun_ = false, has_left_ = false;
  StateParts kept_;  // of the world after the last increment
  AfmPosition kept_position_;
};

}  // namespace pulvis
