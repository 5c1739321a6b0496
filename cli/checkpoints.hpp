// When a run writes checkpoints, and from which one `pulvis resume` continues.
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <stdexcept>

#include "engine/files/checkpoint.hpp"
#include "scenes/read.hpp"

namespace pulvis {

struct CheckpointOptions {
  double every = 60;            // s of wall time
  double time = 0;              // s, interval of simulated time between checkpoints; 0: none
  std::int64_t steps = 0;       // interval in steps (increments of an AFM scene); 0: none
  std::int64_t stop_after = 0;  // step at which the run stops as if interrupted; 0: never
};

class Checkpoints {
 public:
  Checkpoints(const LoadedScene& scene, std::filesystem::path folder,
              const CheckpointOptions& options);

  // Cheap: called after every step. The first checkpoint is due at once, so that a killed run can resume.
  // Those due by wall time are postponed while they would cost more than a hundredth of the run.
  bool due(std::int64_t step, double time) const;
  bool stops(std::int64_t step) const {
    return options_.stop_after > 0 && step >= options_.stop_after;
  }
  void resumed(std::int64_t step, double time) {
    last_step_ = step;
    info_.time = time;
  }
  void of_run(const std::string& id) { info_.run = id; }
  // `world`: its stored parts, or one whose columns are available once `visit` has fetched them.
  void write(std::int64_t step, double time, const StateParts& world, const StateParts& run);
  void write(std::int64_t step, double time, const World& world, const StateParts& run,
             const ColumnVisit& visit = {});
  // As a state from which other runs can start.
  void keep_state(const std::string& name, std::int64_t step, double time,
                  const World& world, const ColumnVisit& visit) const;
  // Nothing is left to resume.
  void remove() const { remove_checkpoints(folder_); }

 private:
  template <class Write>
  void written(std::int64_t step, double time, const Write& write);

  using Time = std::chrono::steady_clock;
  CheckpointInfo info_;
  std::filesystem::path folder_;
  CheckpointOptions options_;
  std::int64_t last_step_ = -1;
  Time::time_point last_ = Time::now();
  Time::duration cost_{};
};

// The folder has no run that can be resumed; what() says why.
class CannotResume : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// A stopped run: its newest intact checkpoint and its scene. Damaged ones are reported on the terminal.
struct StoppedRun {
  std::unique_ptr<Checkpoint> checkpoint;
  LoadedScene scene;
};
void require_stopped_run(
    const std::filesystem::path& folder);  // a folder that may hold one; throws CannotResume
StoppedRun find_stopped_run(const std::filesystem::path& folder);
// Removes what can no longer be resumed: checkpoints of runs other than `run`, and incomplete ones.
void clear_other_checkpoints(const std::filesystem::path& folder, const std::string& run);
// Whether `resume` could continue the run stopped there, and that run has a scene with this hash.
bool can_go_on(const std::filesystem::path& folder, std::uint64_t scene_hash);

}  // namespace pulvis
